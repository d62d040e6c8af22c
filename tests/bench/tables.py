# SPDX-License-Identifier: BSD-3-Clause
"""Tables in Markdown."""


def grouped(number):
    return f"{number:,.0f}".replace(",", " ")


def table_row(cells):
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"


def table_head(titles):
    return [table_row(titles), "|" + " --- |" * len(titles)]
