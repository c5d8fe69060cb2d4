"""Any motion file in: one function from a path to a Motion, one that tells what a file holds."""

from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

import numpy as np

from ...errors import UsageError, UserError, in_range
from ...formats.amass import is_amass, read_amass
from ...formats.arrays import read_npz
from ...formats.blender import as_glb
from ...formats.csv_files import read_motion_csv
from ...formats.limits import array_names, check_size
from ...formats.readers.acclaim import read_amc
from ...formats.readers.bvh import read_bvh
from ...formats.readers.glb import read_glb
from ...formats.readers.humanml import read_humanml
from ...formats.rig import SourceClip
from ...motion.motion import Motion, resample_motion
from ...motion.skeleton import JOINT_INDEX, JOINT_NAMES, canonical_skeleton
from .autodetection import (
    axis_vector,
    detect_unit,
    detect_up,
    joint_indices,
    rest_frame,
    unit_metres,
    unit_name,
)
from .mapping import GUESSED, SkeletonMapping, load_mappings, mapping_of
from .to_canonical import leg_length, retarget

FOLDER_ENDINGS = (".bvh", ".amc", ".npz", ".glb", ".vrma", ".npy", ".fbx")
ENDINGS = (*FOLDER_ENDINGS, ".csv")  # in a folder it may hold captions


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
        return Recording("BVH", clip=read_bvh(path))
    if ending in (".glb", ".vrma", ".vrm"):
        clip, name = read_glb(path), ending[1:].upper()
        still = ("an avatar, which holds no motion: this is how it stands",)
        told = still if ending == ".vrm" and clip.num_frames == 1 else ()
        return Recording(name, clip=clip, up="Y", metres=1.0, text=clip.text, warnings=told)
    if ending == ".fbx":
        with as_glb(path) as glb:
            return replace(open_recording(glb), format="FBX, by Blender")
    if ending == ".csv":
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
    clip = read_amc(path, skeleton, fps=fps)
    warnings = () if clip.rate_is_known else (
        f"AMC files do not say their frame rate; {1 / clip.frame_time:g} is assumed, state it by "
        "--source-fps",
    )  # fmt: skip
    return Recording("ASF/AMC", clip=clip, metres=clip.metres, warnings=warnings)


def _npz(path: Path, fps: float | None) -> Recording:
    names = array_names(path)
    if "quaternions" in names or "format_version" in names:
        return Recording("NPZ of this project", motion=read_npz(path))
    if not is_amass(names):
        shown = ", ".join(name[:40] for name in names[:8]) or "nothing"
        raise UserError(f"{path}: holds {shown}: neither a motion of this project nor AMASS "
                        "(trans, and poses or root_orient and pose_body); "
                        "export it as one of them")  # fmt: skip
    clip, ours = read_amass(path, fps=fps)
    return Recording(
        "AMASS", clip=clip, up="Z", metres=1.0, true_size=True, exact=ours,
        warnings=("no body model is read: body shape, hands, jaw and eyes are dropped, and the "
                  "rotations go onto our own bones",),
    )  # fmt: skip


def _npy(path: Path, fps: float | None) -> Recording:
    return Recording(
        "HumanML3D joints", clip=read_humanml(path, fps=fps), up="Y", metres=1.0,
        warnings=("positions only: rotations are found by inverse kinematics, so the twist of "
                  "arms, legs and head is a guess",),
    )  # fmt: skip


SAME_BONES = 1e-4  # metres: a file with our own skeleton, so nothing is to be fitted
LEGS = (0.4, 1.3)  # metres, hip to ankle: children to giants
RATES = (1.0, 2000.0)  # frames a second
MAX_FRAMES = 200_000  # of a result at another rate: nearly two hours at 30 a second
NEAR_RATE = 0.01  # relative: 119.88 frames a second are thinned out like 120


@dataclass(frozen=True)
class Inspection:
    """What a motion file holds, as far as it says and can be guessed.

    Attributes:
        format: of the file, for example "BVH".
        joints: (name, index of the parent or -1), parents first.
        fps, frames, seconds: of the recording.
        unit: name of the unit of length (see `UNITS`), None where nothing tells.
        up: the up axis, for example "Z".
        guessed: those of "unit" and "up" that were guessed.
        mapping: name of the skeleton profile that fits; None if none does.
        matched: our joint -> joint of the file.
        warnings: what is lost, guessed or odd, a sentence each.
    """

    format: str
    joints: tuple[tuple[str, int], ...]
    fps: float
    frames: int
    seconds: float
    unit: str | None
    up: str
    guessed: tuple[str, ...]
    mapping: str | None
    matched: dict[str, str]
    warnings: tuple[str, ...]


def read_motion(
    path: str | Path,
    *,
    mapping: str | Path | None = None,
    unit: str | None = None,
    up: str | None = None,
    fps: float | None = 30.0,
    skeleton: str | Path | None = None,
    source_fps: float | None = None,
) -> Motion:
    """Read a motion file of any known format onto the canonical skeleton, +Y up, metres.

    A file with our own skeleton (as our writers make) comes back as it was written; any other is
    scaled so that its legs get ours' length and put on the floor.

    Args:
        mapping: YAML with skeleton profiles that go before ours (see configs/skeletons.yaml).
        unit: of length in the file, by name (see `UNITS`): distances then stay true instead
            of being scaled to our legs.
        up: the file's up axis, "Y", "Z", "-X", …; default: as the file says, or guessed.
        fps: of the result; None keeps the file's own.
        skeleton: the ASF file of an AMC motion; default: the one beside it.
        source_fps: of the recording, for formats that do not say (AMC: 120 is assumed).

    Raises:
        UsageError: no path, a rate out of range, or there is no such file.
        UserError: damaged, too large, of no known format, or with joints that no profile
            maps; names the file, the place and the remedy.
    """
    if not isinstance(path, str | PathLike):
        raise UsageError(f"path is {path!r}; give the path of a motion file")
    for name, rate in (("fps", fps), ("source_fps", source_fps)):
        if rate is not None:
            in_range(name, rate, *RATES)
    asf, table = (None if each is None else Path(each) for each in (skeleton, mapping))
    recording = open_recording(Path(path), skeleton=asf, fps=source_fps)
    return fit(Path(path), recording, load_mappings(table), unit=unit, up=up, fps=fps)


def fit(
    path: Path,
    recording: Recording,
    mappings: tuple[SkeletonMapping, ...],
    *,
    unit: str | None = None,
    up: str | None = None,
    fps: float | None = 30.0,
) -> Motion:
    """A recording onto our skeleton; the arguments are those of `read_motion`."""
    if recording.motion is not None:
        own = recording.motion
        _check_length(path, own.seconds, fps)
        return own if fps is None else resample_motion(own, fps)
    clip = recording.clip
    assert clip is not None
    profile = mapping_of(path, clip, mappings)
    ours = is_ours(clip, profile) if recording.exact is None else recording.exact
    up = up or recording.up or ("Y" if ours else detect_up(clip, profile)[0])
    metres = recording.metres if recording.true_size else our_scale(clip, profile) if ours else None
    metres = unit_metres(unit) if unit else metres
    if fps is not None:
        clip = thinned(clip, fps)
        _check_length(path, clip.num_frames * clip.frame_time, fps)
    try:
        motion = retarget(clip, profile, fps=fps, up=up, metres=metres, ground=not ours)
    except ValueError as error:
        raise UserError(f"{path}: {error}") from None
    return replace(motion, text=recording.text)


def _check_length(path: Path, seconds: float, fps: float | None) -> None:
    if fps is not None and seconds * fps > MAX_FRAMES:
        raise UserError(f"{path}: {seconds:.0f} s at {fps:g} frames a second are over the limit of "
                        f"{MAX_FRAMES} frames; split the file or keep its own rate")  # fmt: skip


def thinned(clip: SourceClip, fps: float) -> SourceClip:
    """Every n-th frame, where that alone gives `fps`."""
    rate = 1.0 / clip.frame_time
    stride = max(1, round(rate / fps))
    return clip.every(stride) if abs(rate / stride - fps) < NEAR_RATE * fps else clip


def is_ours(clip: SourceClip, mapping: SkeletonMapping) -> bool:
    """Whether the clip's bones are those of the canonical skeleton, in any unit, by any names."""
    ours = canonical_skeleton()
    index = joint_indices(clip, mapping)
    if len(index) < len(ours.names):
        return False
    order = [index[name] for name in ours.names]
    if any(clip.parents[order[k]] != order[p] for k, p in enumerate(ours.parents) if p >= 0):
        return False
    bones = np.asarray(clip.offsets[order][1:] * our_scale(clip, mapping))
    return bool(np.abs(bones - ours.offsets[1:]).max() < SAME_BONES)


def our_scale(clip: SourceClip, mapping: SkeletonMapping) -> float:
    """Metres of the clip's unit if its left thigh is ours."""
    thigh = canonical_skeleton().offsets[JOINT_INDEX["l_knee"]]
    length = float(np.linalg.norm(clip.offsets[joint_indices(clip, mapping)["l_knee"]]))
    return float(np.linalg.norm(thigh)) / max(length, 1e-12)


def inspect_motion(
    path: str | Path,
    *,
    mapping: Path | None = None,
    unit: str | None = None,
    up: str | None = None,
    skeleton: Path | None = None,
    source_fps: float | None = None,
) -> Inspection:
    """Say what a motion file holds; arguments and errors are those of `read_motion`, but for joints
    that no profile maps."""
    recording = open_recording(Path(path), skeleton=skeleton, fps=source_fps)
    if recording.motion is not None:
        return _inspect_ours(recording, recording.motion)
    clip = recording.clip
    assert clip is not None
    profiles = load_mappings(mapping)
    for check, value in ((axis_vector, up), (unit_metres, unit)):
        if value is not None:
            check(value)
    warnings = list(recording.warnings)
    unit, up = unit or unit_name(recording.metres), up or recording.up
    profile = None
    guessed = tuple(name for name, value in (("unit", unit), ("up", up)) if value is None)
    try:
        profile = mapping_of(Path(path), clip, profiles)
    except UserError as error:
        warnings.append(str(error))
    if profile is not None:
        legs = leg_length(clip, profile)
        unit = unit or detect_unit(legs)
        up, more = _upright(clip, profile, up)
        warnings += more + _doubts(clip, profile, legs * unit_metres(unit), unit)
    return Inspection(
        format=recording.format,
        joints=tuple(zip(clip.names, clip.parents, strict=True)),
        fps=1.0 / clip.frame_time,
        frames=clip.num_frames,
        seconds=clip.num_frames * clip.frame_time,
        unit=unit,
        up=up or "Y",
        guessed=guessed,
        mapping=profile.name if profile else None,
        matched=dict(profile.joints) if profile else {},
        warnings=tuple(warnings),
    )


def _upright(clip: SourceClip, profile: SkeletonMapping, up: str | None) -> tuple[str, list[str]]:
    """The up axis, and what is to be said of it."""
    if up is None and is_ours(clip, profile):
        return "Y", []
    found, certain = detect_up(clip, profile)
    if up is None:
        doubt = f"the body is not upright on average: up axis {found} is a guess, state --up"
        return found, [] if certain else [doubt]
    if certain and not np.allclose(axis_vector(found), axis_vector(up)):
        return up, [f"the body stands along {found}, not {up}: check --up"]
    return up, []


def _doubts(clip: SourceClip, profile: SkeletonMapping, legs: float, unit: str) -> list[str]:
    """What a reader should know of a file before trusting it; `legs` in metres."""
    doubts = []
    if profile.name == GUESSED:
        doubts.append("no profile knows the joints' names, so bones and words told which is which; "
                      "where that is wrong, correct it (--write-mapping begins)")  # fmt: skip
    if not LEGS[0] < legs < LEGS[1]:
        doubts.append(f"legs of {legs:.2g} m, if the unit is {unit}: check --unit")
    missing = [name for name in JOINT_NAMES if name not in profile.joints]
    if missing:
        doubts.append(f"no joint for {', '.join(missing)}: interpolated between the neighbours")
    if not profile.axes and rest_frame(clip, profile) is None:
        doubts.append("the rest pose is no standing body: which way its joints are twisted is "
                      "found from the motion; `axes` in a profile state it")  # fmt: skip
    return doubts


def _inspect_ours(recording: Recording, motion: Motion) -> Inspection:
    skeleton = canonical_skeleton()
    return Inspection(
        format=recording.format,
        joints=tuple(zip(skeleton.names, skeleton.parents, strict=True)),
        fps=motion.fps,
        frames=motion.num_frames,
        seconds=motion.seconds,
        unit="m",
        up="Y",
        guessed=(),
        mapping="motion-suite",
        matched={name: name for name in skeleton.names},
        warnings=recording.warnings,
    )
