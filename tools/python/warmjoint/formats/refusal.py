"""What is refused, and in which words; needs no package."""

LONGEST = 1500  # characters of a sentence
OF_THE_INSIDE = (AttributeError, AssertionError, LookupError, OverflowError, RecursionError, TypeError, UnicodeError, ZeroDivisionError)


class Refusal(Exception):
    """An input that cannot be used: place, value, remedy."""


def sentence(text):
    """A text on one line, cut where it is long."""
    line = " ".join(str(text).split())
    return line if len(line) <= LONGEST else line[:LONGEST] + " ..."


def first_line(error):
    """What a library says of a file, in a line; of a fault within it nothing that a user could act on is said."""
    words = str(error).strip().splitlines()
    return "it is damaged, or of a form that is not known here" if isinstance(error, OF_THE_INSIDE) or not words else words[0][:200]
