"""MPMS, the motion-phrase memory: phrases of real motion, found by what a song sounds like."""
