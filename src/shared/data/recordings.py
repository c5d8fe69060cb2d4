"""Which reader takes a motion file: by the ending of its name, then by what it holds."""

from dataclasses import dataclass
from pathlib import Path

from ..errors import UserError
from ..formats.limits import array_names, check_size
from ..formats.rig import SourceClip
from ..motion.motion import Motion

FOLDER_ENDINGS = (".bvh", ".amc", ".npz", ".glb", ".npy")  # a folder's .csv may hold captions
ENDINGS = (*FOLDER_ENDINGS, ".csv")


@dataclass(frozen=True, eq=False)
class Recording:
    """An opened motion file.

    Attributes:
        format: for people, for example "ASF/AMC".
        motion: set for our own files, which need no fitting; else
        clip: the recording on its own skeleton.
        up: the up axis, where the format fixes it.
        metres: of the unit of length, where the format fixes it.
        true_size: distances are not to be scaled to our legs: the file has no legs of its own.
        exact: the body is ours already: rotations and places are taken as they are; None: if the
            bones are ours.
        text: caption or prompt, where the file holds one.
        warnings: what the format loses or does not say, a sentence each.
    """

    format: str
    motion: Motion | None = None
    clip: SourceClip | None = None
    up: str | None = None
    metres: float | None = None
    true_size: bool = False
    exact: bool | None = None
    text: str = ""
    warnings: tuple[str, ...] = ()


def open_recording(
    path: Path, *, skeleton: Path | None = None, fps: float | None = None
) -> Recording:
    """Read a motion file with the reader for it.

    Raises:
        UserError: missing, damaged, too large or of no known format.
    """
    check_size(path)
    ending = path.suffix.lower()
    if ending == ".bvh":
        from ..formats.readers.bvh import read_bvh

        return Recording("BVH", clip=read_bvh(path))
    if ending == ".glb":
        from ..formats.readers.glb import read_glb

        clip = read_glb(path)
        return Recording("GLB", clip=clip, up="Y", metres=1.0, text=clip.text)
    if ending == ".csv":
        from ..formats.csv_files import read_motion_csv

        return Recording("CSV of this project", motion=read_motion_csv(path))
    if ending == ".amc":
        return _amc(path, skeleton, fps)
    if ending == ".npz":
        return _npz(path, fps)
    if ending == ".npy":
        return _npy(path, fps)
    raise UserError(f"{path}: no reader for {ending or 'a file without ending'!r}; "
                    f"known: {', '.join(ENDINGS)}; export it as one of them")  # fmt: skip


def _amc(path: Path, skeleton: Path | None, fps: float | None) -> Recording:
    from ..formats.readers.acclaim import read_amc

    clip = read_amc(path, skeleton, fps=fps)
    warnings = () if clip.rate_is_known else (
        f"AMC files do not say their frame rate; {1 / clip.frame_time:g} is assumed, state it by "
        "--source-fps",
    )  # fmt: skip
    return Recording("ASF/AMC", clip=clip, metres=clip.metres, warnings=warnings)


def _npz(path: Path, fps: float | None) -> Recording:
    from ..formats.amass import is_amass, read_amass
    from ..formats.arrays import read_npz

    names = array_names(path)
    if "quaternions" in names or "format_version" in names:
        return Recording("NPZ of this project", motion=read_npz(path))
    if not is_amass(names):
        shown = ", ".join(name[:40] for name in names[:8]) or "nothing"
        raise UserError(f"{path}: holds {shown}: neither a motion of this project nor AMASS "
                        "(trans, and poses or root_orient and pose_body); "
                        "export it as one of them")  # fmt: skip
    clip = read_amass(path, fps=fps)
    return Recording(
        "AMASS", clip=clip, up="Z", metres=1.0, true_size=True, exact=clip.ours,
        warnings=("no body model is read: body shape, hands, jaw and eyes are dropped, and the "
                  "rotations go onto our own bones",),
    )  # fmt: skip


def _npy(path: Path, fps: float | None) -> Recording:
    from ..formats.readers.humanml import read_humanml

    return Recording(
        "HumanML3D joints", clip=read_humanml(path, fps=fps), up="Y", metres=1.0,
        warnings=("positions only: rotations are found by inverse kinematics, so the twist of "
                  "arms, legs and head is a guess",),
    )  # fmt: skip
