"""A log in a compressed file, or alone in an archive: unpacked within bounds, and read as what it is."""

import bz2
import gzip
import lzma
import pathlib
import shutil
import tempfile
import zipfile
import zlib

from refusal import Refusal

LARGEST = 4 << 30  # bytes of what is unpacked, as of a file that the program reads
OPENERS = {".gz": gzip.open, ".bz2": bz2.open, ".xz": lzma.open}


def alone_in(path, archive):
    """The one file of an archive; what systems put beside files does not count."""
    members = [one for one in archive.infolist() if not one.is_dir() and not one.filename.startswith("__MACOSX/")]
    if len(members) != 1:
        raise Refusal(f"{path}: holds {len(members)} files; unpack it, and give the log")
    return members[0]


def copied(path, source, target):
    """The bytes of an open file in a file; refuses more than LARGEST."""
    with open(target, "wb") as file:
        left = LARGEST
        while block := source.read(min(1 << 20, left + 1)):
            left -= len(block)
            if left < 0:
                raise Refusal(f"{path}: holds more than {LARGEST >> 30} GiB; unpack it, and take a part of it")
            file.write(block)


def unpacked(path, read, readers):
    """What `read` gives of the file inside; a table of text as bytes."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="warmjoint_"))
    try:
        if path.suffix.lower() == ".zip":
            with zipfile.ZipFile(path) as archive:
                member = alone_in(path, archive)
                # the name alone: a path in an archive may lead anywhere
                inside = folder / (pathlib.PurePosixPath(member.filename).name or "log")
                with archive.open(member) as source:
                    copied(path, source, inside)
        else:
            inside = folder / (path.stem or "log")
            with OPENERS[path.suffix.lower()](path) as source:
                copied(path, source, inside)
        ending = max((one for one in readers if inside.name.lower().endswith(one)), key=len, default="")
        if readers.get(ending) == "read_packed":
            raise Refusal(f"{path}: holds {inside.name}, which is packed again; unpack it")
        return read(inside) if ending else (inside.read_bytes(), [])
    except Refusal as refusal:
        raise Refusal(str(refusal).replace(f"{folder}/", f"{path}: ")) from None
    except (OSError, EOFError, RuntimeError, NotImplementedError, lzma.LZMAError, zipfile.BadZipFile, zlib.error) as error:
        reason = "it asks for a password" if isinstance(error, RuntimeError) and "password" in str(error) else "it is damaged, or cut"
        raise Refusal(f"{path}: cannot be unpacked: {reason}") from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)
