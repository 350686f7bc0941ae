"""Answers one request of `warmjoint` on standard input: figures to draw, or a page to fill.

A request is a line of JSON, {facts, sizes[]}, and arrays of float64 behind it (tools/shown/shown_data.h). The answer to figures is a line of
JSON, {files[{source, name, finding, is_data, size}], left_out[]} or {refusal{place, why}}, and the files behind it; to a page {size} or
{refusal{place, why}}, and its HTML. Nothing of the folder that the program runs in, and no setting of the user's for matplotlib, changes either.
"""

import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
WORKING = os.getcwd()
os.chdir(HERE)  # whose matplotlibrc is the first that matplotlib looks for, when it is imported
os.environ.update(MPLBACKEND="agg", MATPLOTLIBRC=os.path.join(HERE, "matplotlibrc"))
sys.path[0] = os.path.dirname(HERE)

import contextlib  # noqa: E402

import numpy as np  # noqa: E402

with contextlib.suppress(ImportError):  # what draws says what is missing
    import matplotlib  # noqa: F401
os.chdir(WORKING)  # paths of a request may be relative

from figures.view import unpacked  # noqa: E402

sys.path.pop(0)  # other modules of that folder are none of others


def read_request(stream):
    """The facts with their arrays."""
    head = json.loads(stream.readline())
    numbers = np.frombuffer(stream.read(), "=f8")
    return unpacked(head["facts"], np.split(numbers, np.cumsum(head["sizes"])[:-1]) if head["sizes"] else [])


def main():
    request = read_request(sys.stdin.buffer)
    if "page" in request:
        from figures import pages

        return sys.stdout.buffer.write(pages.answer(request["page"], request["content"]))
    from figures import plot

    return sys.stdout.buffer.write(plot.answer(request))


if __name__ == "__main__":
    main()
