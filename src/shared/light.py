"""Whether this process is to compute without PyTorch, which takes seconds to import.

Asked for before anything of motions is imported, and for the whole process: `tensors` looks here
once.
"""

wanted = False


def compute_without_torch() -> None:
    """Let NumPy stand in for PyTorch wherever nothing is learned, if nothing has chosen yet."""
    global wanted
    wanted = True
