"""Damaged files made from whole ones: bytes, text, trees of values, arrays, containers.

Every mutation is a function of (a random generator, the whole file's bytes), so that a case is
named by reader, seed and number alone.
"""

import copy
import io
import json
import random
import re
import struct
import zipfile
import zlib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

Mutation = Callable[[random.Random, bytes], bytes]

NUMBERS = (
    b"0", b"-1", b"1", b"2", b"nan", b"inf", b"-inf", b"1e308", b"1e999", b"-1e-320", b"1e7",
    b"2147483648", b"4294967295", b"9223372036854775808", b"0x10", b"1_000", b"1,5", b"1e",
    b"+-3", b"9" * 5000, "١٢".encode(), b"999999", b"1000001",
)  # fmt: skip
SCRAPS = (
    b"", b"\0", b"\n", b"\r\n", b"\t", b" ", b"{", b"}", b"[", b"]", b'"', b"'", b":", b",", b"#",
    b"\\", b"/", b"../../etc/passwd", b"\xff\xfe", b"\xef\xbb\xbf", b"\xed\xa0\x80",
    "Пример ジョイント".encode(), b"A" * 3000, b"%s%n", b"null", b"true",
    b"!!python/object/apply:os.system",
    b"&a [*a]", b"*a", b"<<: *a", b"- - - -", b"__proto__",
)  # fmt: skip
VALUES: tuple[Any, ...] = (
    None, True, False, 0, 1, -1, 2, 7, 1000, 2**31, 2**53, 2**63, 10**400, 0.5, -0.0, 1e308, 1e-320,
    float("nan"), float("inf"), "", "0", "nan", "../../x", "A" * 2000, "\ud800", [], {}, [[]], [0],
    [1, 2, 3], {"a": 1}, [[[[[]]]]], "float32", "é",
)  # fmt: skip
DTYPES = ("<f8", "<f4", "<f2", ">f4", "<i8", "|u1", "<c16", "|b1", "<U3", "|S2", "<M8[s]", "|O")


# ---------------------------------------------------------------- bytes


def mutate_bytes(rng: random.Random, data: bytes) -> bytes:
    """A few damages to plain bytes."""
    result = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 4, 8))):
        if not result:
            result += rng.randbytes(rng.randrange(1, 64))
        at = rng.randrange(len(result))
        end = min(len(result), at + rng.choice((1, 2, 4, 8, 64, 1024)))
        match rng.randrange(9):
            case 0:
                result[at] ^= 1 << rng.randrange(8)
            case 1:
                result[at] = rng.choice((0, 1, 127, 128, 255, rng.randrange(256)))
            case 2:
                del result[at:end]
            case 3:
                result[at:at] = result[at:end] * rng.choice((1, 2, 50))
            case 4:
                result[at:at] = rng.randbytes(rng.choice((1, 4, 100)))
            case 5:
                del result[at:]
            case 6:
                other = rng.randrange(len(result))
                piece = bytes(result[at:end])
                result[other : other + len(piece)] = piece
            case 7:
                size = rng.choice((1, 2, 4, 8))
                number = rng.choice((0, 1, -1, 2**7, 2**15, 2**31, 2**63, 2**31 - 1, 65_537))
                order = rng.choice(("little", "big"))
                result[at : at + size] = (number % 256**size).to_bytes(size, order)
            case _:
                result[at:end] = bytes(end - at)
    return bytes(result)


# ---------------------------------------------------------------- text


def text_mutation(words: Sequence[bytes]) -> Mutation:
    """Damages to lines and words; `words` are those the format knows."""

    def mutate(rng: random.Random, data: bytes) -> bytes:
        if rng.random() < 0.01:
            return deep(rng)
        lines = data.split(b"\n")
        for _ in range(rng.choice((1, 1, 2, 3, 6))):
            at = rng.randrange(len(lines))
            end = min(len(lines), at + rng.choice((1, 1, 2, 5, 20)))
            match rng.randrange(10):
                case 0:
                    del lines[at:end]
                case 1:
                    lines[at:at] = lines[at:end]
                case 2:
                    lines[at:at] = lines[at:end] * rng.choice((3, 30, 300))
                case 3:
                    other = rng.randrange(len(lines))
                    lines[at], lines[other] = lines[other], lines[at]
                case 4:
                    del lines[at:]
                case 5:
                    lines[at] = rng.choice(SCRAPS).join(lines[at].split(b" "))
                case 6:
                    lines.insert(at, rng.choice((*words, *SCRAPS)) * rng.choice((1, 1, 200)))
                case _:
                    lines[at] = _other_word(rng, lines[at], words)
            lines = lines or [b""]
        return rng.choice((b"\n", b"\n", b"\n", b"\r\n", b"\r")).join(lines)

    return mutate


def _other_word(rng: random.Random, line: bytes, words: Sequence[bytes]) -> bytes:
    """The line with one of its words changed; half of the time a number to another number."""
    parts = line.split(b" ")
    numbers = [i for i, part in enumerate(parts) if re.fullmatch(rb"\s*-?[0-9.e-]+\s*", part)]
    if numbers and rng.random() < 0.5:
        count = rng.choice((1, 1, 1, len(numbers)))
        for at in rng.sample(numbers, count):
            parts[at] = rng.choice(
                (b"0", b"-1", b"1e6", b"1e-30", b"9999999", b"-90", b"0.5", b"3")
            )
        return b" ".join(parts)
    at = rng.randrange(len(parts))
    match rng.randrange(6):
        case 0 | 1:
            parts[at] = rng.choice(NUMBERS)
        case 2:
            parts[at] = rng.choice((*words, *SCRAPS))
        case 3:
            del parts[at]
        case 4:
            parts[at:at] = [parts[at]] * rng.choice((1, 3, 500))
        case _:
            parts[at] = mutate_bytes(rng, parts[at])[:4000]
    return b" ".join(parts)


# ---------------------------------------------------------------- trees of values (JSON)


def mutate_tree(rng: random.Random, tree: Any) -> Any:
    """The same tree with one or a few nodes changed, gone, doubled or swapped."""
    tree = json.loads(json.dumps(tree))
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        places = list(_places(tree))
        if not places:
            return copy.deepcopy(rng.choice(VALUES))
        holder, key = rng.choice(places)
        match rng.randrange(8):
            case 0 | 1 | 2:
                holder[key] = copy.deepcopy(rng.choice(VALUES))
            case 3:
                if isinstance(holder[key], (int, float)):
                    step = rng.choice((-1, 1, 1000, 0.5, -1000))
                    holder[key] += int(step) if isinstance(holder[key], int) else step
                else:
                    holder[key] = [holder[key]]
            case 4:
                del holder[key]
            case 5:
                other, at = rng.choice(places)
                if at in other if isinstance(other, dict) else at < len(other):
                    holder[key] = json.loads(json.dumps(other[at]))
            case 6:
                if isinstance(holder, list):
                    holder[key:key] = [holder[key]] * rng.choice((1, 2, 1000))
                else:
                    holder[rng.choice(("", "extra", "Ω", key + "s"))] = holder.pop(key)
            case _:
                holder[key] = {"a": holder[key]}
    return tree


def _places(tree: Any) -> list[tuple[Any, Any]]:
    """(container, key) of every node but the root; the first 3000."""
    found: list[tuple[Any, Any]] = []
    waiting = [tree]
    while waiting and len(found) < 3000:
        here = waiting.pop()
        keys = list(here) if isinstance(here, dict) else list(range(len(here)))
        for key in keys:
            found.append((here, key))
            if isinstance(here[key], (dict, list)):
                waiting.append(here[key])
    return found


def deep(rng: random.Random) -> bytes:
    """Nesting that no recursive parser survives."""
    opening, middle, closing = rng.choice(
        (
            (b"[", b"1", b"]"),
            (b'{"a":', b"1", b"}"),
            (b"[{}, [", b"", b"]]"),
            (b"[", b"", b""),
            (b"- ", b"1", b""),
        )
    )
    depth = rng.choice((500, 5_000, 100_000))
    return opening * depth + middle + closing * depth


def mutate_json(rng: random.Random, data: bytes) -> bytes:
    """Damages to the tree of a JSON file; now and then one that is only deep."""
    if rng.random() < 0.03:
        return deep(rng)
    return _dump(mutate_tree(rng, json.loads(data)))


def mutate_json_lines(rng: random.Random, data: bytes) -> bytes:
    """Damages to one line of a file with a JSON value a line."""
    lines = data.splitlines() or [b"{}"]
    at = rng.randrange(len(lines))
    lines[at] = mutate_json(rng, lines[at])
    return b"\n".join(lines) + b"\n"


def _dump(tree: Any) -> bytes:
    return json.dumps(tree).encode("utf-8", "surrogatepass")


# ---------------------------------------------------------------- arrays (NPY, NPZ)


def mutate_array(rng: random.Random, array: np.ndarray) -> np.ndarray:
    """Another type, shape or values."""
    match rng.randrange(9):
        case 0:
            target = rng.choice(DTYPES)
            with np.errstate(all="ignore"):
                try:
                    return array.astype(target)
                except (ValueError, TypeError):
                    return array.astype(object)
        case 1:
            return array[..., None]
        case 2:
            return array[None]
        case 3:
            return array.T.copy() if array.ndim else np.stack([array] * 3)
        case 4:
            return array[: rng.choice((0, 1, 2))] if array.ndim else np.zeros((0,), array.dtype)
        case 5:
            return np.array(rng.choice((0, 1, -1, 1e30, np.nan, "text", b"bytes", True)))
        case 6 if array.dtype.kind == "f" and array.size:
            changed = array.copy().reshape(-1)
            count = rng.choice((1, 1, len(changed)))
            value = rng.choice((np.nan, np.inf, -np.inf, 0.0, 1e30, -1e30, 3e38, 1e-38))
            with np.errstate(over="ignore"):
                changed[rng.sample(range(len(changed)), count)] = value
            return changed.reshape(array.shape)
        case 7 if array.ndim and array.shape[-1] > 1:
            return array[..., :-1]
        case _:
            return np.concatenate([array, array], -1) if array.ndim else array.reshape(1)


def npy_bytes(rng: random.Random, array: np.ndarray) -> bytes:
    """The array in NPY form; now and then with a header that lies."""
    stream = io.BytesIO()
    np.lib.format.write_array(stream, array, allow_pickle=True)
    data = stream.getvalue()
    if rng.random() < 0.25:
        shape = rng.choice(
            ((10**9,), (2**62,), (10**5, 10**5), (-1,), (0, 10**12), (), (1,) * 70, (2**40, 0))
        )
        order = rng.random() < 0.3
        text = repr({"descr": rng.choice(DTYPES), "fortran_order": order, "shape": shape})
        text = text.ljust(rng.choice((117, 117, 117, 60_000))) + "\n"
        header = b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text.encode()
        return header + data[128:]
    return data


def mutate_npy(rng: random.Random, data: bytes) -> bytes:
    """Damages to the one array of an NPY file."""
    return npy_bytes(rng, mutate_array(rng, np.load(io.BytesIO(data))))


def mutate_npz(rng: random.Random, data: bytes) -> bytes:
    """Damages to the arrays of an NPZ file, and to the archive around them."""
    with np.load(io.BytesIO(data)) as stored:
        arrays = {name: stored[name] for name in stored.files}
    members = {}
    changed = rng.sample(sorted(arrays), min(len(arrays), rng.choice((1, 1, 2))))
    for name, array in arrays.items():
        if name in changed and rng.random() < 0.8:
            array = mutate_array(rng, array)
        elif name in changed:
            match rng.randrange(3):
                case 0:
                    continue
                case 1:
                    name = rng.choice(("other", "../../x", name.upper(), "", "a/b"))
                case _:
                    array = arrays[rng.choice(sorted(arrays))]
        members[name] = npy_bytes(rng, array) if name in changed else _plain(array)
    return _archive(rng, members)


def _plain(array: np.ndarray) -> bytes:
    stream = io.BytesIO()
    np.lib.format.write_array(stream, array)
    return stream.getvalue()


def _archive(rng: random.Random, members: dict[str, bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(
        stream, "w", rng.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
    ) as file:
        for name, data in members.items():
            file.writestr(f"{name}.npy", data)
            if rng.random() < 0.02:
                file.writestr(f"{name} .npy", bytes(8 << 20))  # what is not asked for
    data = bytearray(stream.getvalue())
    if rng.random() < 0.1:  # flags of the first entry: encryption, unknown compression, sizes
        at = data.find(b"PK\1\2") + rng.choice((8, 10, 20, 24))
        data[at : at + 2] = rng.choice((b"\x01\x00", b"\x63\x00", b"\xff\xff"))
    return bytes(data)


# ---------------------------------------------------------------- containers


def mutate_glb(rng: random.Random, data: bytes) -> bytes:
    """Damages to the document of a GLB, or to its numbers, in chunks of the right length."""
    size = struct.unpack_from("<I", data, 12)[0]
    document, binary = json.loads(data[20 : 20 + size]), data[28 + size :]
    if rng.random() < 0.2:
        binary = mutate_bytes(rng, binary)
    else:
        document = mutate_tree(rng, document)
    text = deep(rng) if rng.random() < 0.02 else _dump(document)
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def mutate_safetensors(rng: random.Random, data: bytes) -> bytes:
    """Damages to the header of a safetensors file, its length kept true or not."""
    size = struct.unpack_from("<Q", data)[0]
    header, values = json.loads(data[8 : 8 + size]), data[8 + size :]
    text = deep(rng) if rng.random() < 0.05 else _dump(mutate_tree(rng, header))
    length = rng.choice((len(text), len(text), len(text), 0, 2**40, 2**63, len(text) + 1))
    return struct.pack("<Q", length) + text + values


def mutate_sound(rng: random.Random, data: bytes) -> bytes:
    """Damages to the first bytes of a sound file, where its numbers stand, with checksums mended
    where that is easy (ogg's are not, so damaged pages are dropped by the decoder)."""
    cut = min(len(data), rng.choice((64, 256, 4096)))
    return mutate_bytes(rng, data[:cut]) + data[cut:]


def crc32(data: bytes) -> int:
    """A number that is the same in every process, unlike `hash`."""
    return zlib.crc32(data)
