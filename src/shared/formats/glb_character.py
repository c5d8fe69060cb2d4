"""A user's own character, put in motion: their GLB file with our animation in it."""

from pathlib import Path

from .glb import animation
from .glb_reader import GlbSkeleton
from .rig import RigClip, rescaled


def write_glb_character(skeleton: GlbSkeleton, clip: RigClip, path: str | Path) -> Path:
    """Write the character's file again, mesh and all, with the clip as its only animation.

    Args:
        skeleton: of `glb_reader.read_glb_skeleton`.
        clip: a motion of `skeleton.rig`.
        path: the file; may not be the character's own.

    Raises:
        UserError: the file cannot be written.
    """
    from .glb_file import GlbFile

    document = dict(skeleton.file.document)
    for name in ("accessors", "bufferViews"):
        document[name] = list(document.get(name, []))
    file = GlbFile(document, bytes(skeleton.file.data))
    keys = animation(
        rescaled(clip, 1.0),
        file,
        skeleton.nodes,
        skeleton.rig.frames,
        base=skeleton.base,
        scales=skeleton.scales,
    )
    document["animations"] = [keys | {"name": clip.text or "motion"}]
    return file.write(Path(path))
