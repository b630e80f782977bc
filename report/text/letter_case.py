"""Texts that begin a sentence, or stand within one."""

from __future__ import annotations


def capitalized(text: str) -> str:
    """Return a text with its first letter in upper case, the rest as it is."""
    return text[:1].upper() + text[1:]


def lowered(text: str) -> str:
    """Return a text with its first letter in lower case, as within a sentence.

    A symbol such as V/N, an abbreviation and Risk Category stay as they are.
    """
    is_word = text[1:2].islower() or text[1:2] == " "
    return text[:1].lower() + text[1:] if is_word and not text.startswith("Risk Category") else text
