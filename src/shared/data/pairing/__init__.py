"""Motion and music that were never recorded together, paired beat on beat."""
