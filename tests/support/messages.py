"""Messages are compared by their place and their key words: how they are put may change."""

import re


def tells(message: str, *, at: str, of: tuple[str, ...] | str = ()) -> bool:
    """Whether a message begins with its place, and has all key words, in any order and case.

    Args:
        message: The message; ``error:`` before its place is no part of it.
        at: The place, as in ``FILE:3: methods.gsog.shape``.
        of: The key words.
    """
    words = (of,) if isinstance(of, str) else of
    text = re.sub(r"\s+", " ", message.removeprefix("error: "))
    return text.startswith(at) and all(word.lower() in text.lower() for word in words)
