# SPDX-License-Identifier: BSD-3-Clause
"""The command that made a page, as others can give it: folders of one machine say nothing to them."""
import shlex
import sys


def shown_command(program, hidden, files=()):
    """As it was given, with words for the values of the options in `hidden`, and FILE... for the files."""
    shown, rest, files = [program], iter(sys.argv[1:]), {str(file) for file in files}
    for word in rest:
        option, equals, _ = word.partition("=")
        if option in hidden:
            shown += [option, hidden[option]]
            if not equals:
                next(rest, None)
        elif str(word) not in files:
            shown.append(shlex.quote(word))
    return " ".join(shown + (["FILE..."] if files else []))
