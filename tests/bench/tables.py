# SPDX-License-Identifier: BSD-3-Clause
"""Tables in Markdown."""


def grouped(number):
    return f"{number:,.0f}".replace(",", " ")


def table_row(cells):
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"


def table_head(titles):
    return [table_row(titles), "|" + " --- |" * len(titles)]


def give(text, path):
    """Writes a text to the file, or to standard output if there is none."""
    if path:
        path.write_text(text + "\n")
    else:
        print(text)
