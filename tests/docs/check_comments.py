#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds comments that are fragments ("Of what bounds the domain."), that personify code ("as many points as each
wants"), or that use an everyday phrase where the field has a term ("one too many"). It reads the comments of C, C++,
Fortran, Python and CMake files, and prints for each finding: file:line: reason: sentence.
usage: check_comments.py <folder> [--self-test]"""

import pathlib
import re
import sys
import tempfile

import checks

FOLDERS = "src", "include", "tests", "bindings/fortran"

# A sentence must not begin with one of these words. It names its subject instead.
NEVER_FIRST = "Who Whose Whom Whoever Whatever Wherever Those Nobody Everybody Anyone Everyone".split()

# A sentence that begins with one of these words needs a comma and a main clause: "Of equal gains, the first counts."
# After "What" and "Which" two verbs are enough: "What is thinner is lost."
CLAUSE_FIRST = "Of Which What".split()

# A sentence that begins with this word needs a comma and a second clause.
CONDITION_FIRST = "Where"

# A short sentence that begins with one of these words needs a verb. "On all ranks." has none.
PREPOSITIONS = ("In On For From To With Without By As At Before After Between Behind Beside Beyond Along Over Under "
                "Until Since Within Afterwards").split()
SHORT = 6  # words

# A sentence that begins with one of these words and ends with a question mark is a question.
QUESTIONS = "Is Are Has Have Does Do Can Must May Was Were".split()

VERB = re.compile(r"\b(is|are|was|were|has|have|had|can|cannot|may|might|must|do|does|did|will|would|could|should|lies|"
                  r"(need|decide|count|contain|consist|belong|remain|follow|come|begin|keep|return|hold|move|get|stay|fail|"
                  r"become)s?)\b")

# Words and phrases to avoid, as regular expressions, and the reason.
PHRASES = {
    r"told|tells? (?!apart)\w+|(is|are|was|were|be|been) asked|asks|(ranks|nodes|threads|calls|functions|files) ask|"
    r"wants|(it|they|ranks) want|wishes|lets? go|letting go|sees? to it":
        "personifies code",
    r"nobody|anyone('s)?|everyone|whoever|whomever":
        "does not name the rank, caller or object",
    r"anew|mend(s|ed|ing)?|for want of|for good|at hand|whereof|thereof|its kin|one too many|so far as|so much as|"
    r"not there|no longer there|that (is|are) there|(its|their) minds?|business|go(es)? first|handed out|"
    r"hands? out|comes? upon|comes? to an?|not none":
        "is an everyday phrase",
    r"(the|these|those|both|its|their|many|two|other) places (of|where|at|in|that|are|is)|places? (of|in) degrees":
        "says place for a point or an index",
}
PHRASES = {re.compile(rf"\b({words})(?![\w'])", re.I): reason for words, reason in PHRASES.items()}

C_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|//(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/', re.S)
LINE_COMMENT = {"#": re.compile(r"^[ \t]*#(?!!)(?P<line>.*)$", re.M), "!": re.compile(r"^[ \t]*!(?P<line>.*)$", re.M)}
KINDS = {".cpp": "C", ".hpp": "C", ".c": "C", ".h": "C", ".py": "#", ".txt": "#", ".cmake": "#", ".f90": "!"}

# Quoted code, formulas, lists and rulers in comments are not prose.
CODE = re.compile(r"`[^`]*`|\"[^\"]*\"|\b\w+(?:::\w+)+|\b\w+\([^()]*\)")
NO_PROSE = re.compile(r"\s*(SPDX-|clang-format|NOLINT|namespace\b|[-=!]{3,}|[|])")
END = re.compile(r"(?<![ (][A-Za-z])(?<!\be\.g)(?<!\bi\.e)(?<!\bal)(?<!\bcf)[.!?](?=\s+[^a-z\s]|\s*$)")


def comments(text, kind):
    """Line number and text of each comment. Consecutive lines that have nothing else are one comment."""
    found, last = [], -1
    for match in (C_COMMENT if kind == "C" else LINE_COMMENT[kind]).finditer(text):
        parts = match.groupdict()
        content = parts["line"] if parts["line"] is not None else parts.get("block")
        if content is None:  # a literal
            continue
        line = text.count("\n", 0, match.start()) + 1
        if parts["line"] is None:
            content = re.sub(r"^\s*\*+", "", content, flags=re.M)
        elif NO_PROSE.match(content) or not content.strip(" /#!<>"):
            last = -1
            continue
        alone = not text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip()
        if alone and line == last + 1:
            found[-1][1] += "\n" + content.lstrip("/#!<>")
        else:
            found.append([line, content.lstrip("/#!<>")])
        last = line + content.count("\n") if alone and parts["line"] is not None else -1
    return found


def sentences(comment):
    """The sentences of a comment, each with the number of its first line within the comment."""
    begin = 0
    for end in [match.end() for match in END.finditer(comment)] + [len(comment)]:
        sentence = comment[begin:end]
        if sentence.strip():
            skipped = len(sentence) - len(sentence.lstrip())
            yield comment.count("\n", 0, begin + skipped), " ".join(sentence.split())
        begin = end


def reason_against(sentence):
    """Why the sentence should be written in another way, or None."""
    prose = CODE.sub("X", sentence)
    first = re.match(r"[A-Za-z]+\b", prose)
    word = first[0] if first else ""
    _, comma, rest = prose.partition(", ")
    if word in NEVER_FIRST:
        return f"begins with {word}"
    verbs = VERB.findall(prose)
    if word in CLAUSE_FIRST and not (comma and VERB.search(rest) or word != "Of" and len(verbs) > 1):
        return f"begins with {word} and has no main clause"
    if word == CONDITION_FIRST and not comma:
        return f"begins with {word} and has no main clause"
    if word in PREPOSITIONS and len(prose.split()) <= SHORT and not (verbs or re.search("[,:]|^For use|^By default", prose)):
        return f"begins with {word} and has no verb"
    if word in QUESTIONS and prose.endswith("?"):
        return "is a question"
    for phrase, reason in PHRASES.items():
        match = phrase.search(prose)
        if match:
            return f"\"{match[0]}\" {reason}"
    return None


def findings(root):
    """File, line and message of each finding, and the number of files."""
    found, files = [], 0
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            kind = KINDS.get(path.suffix)
            if not kind or path.suffix == ".txt" and path.name != "CMakeLists.txt":
                continue
            files += 1
            for line, comment in comments(path.read_text(encoding="utf-8", errors="replace"), kind):
                for offset, sentence in sentences(comment):
                    reason = reason_against(sentence)
                    if reason:
                        found.append((path.relative_to(root).as_posix(), line + offset, f"{reason}: {sentence}"))
    return found, files


def faults(root):
    """What is wrong, a line each."""
    found, files = findings(root)
    if not files:
        yield f"{root}: no files"
    for file, line, message in found:
        yield f"{file}:{line}: {message}"


BAD = """
Of what bounds the domain.
Who has what.
Of a triangle with these sides.
nodes must outlive this; by: not none.
Deals the work out anew where it has become unequal
Where a node is one too many or one is missing that the overlap ratios do not tell.
It says when a level is made, moved and finished; how is its parts' business.
What is to be told of a level and of a finished run. Each warning is empty if there is nothing.
Nodes that coincide would have no star, so they go first.
From now on this one, whose results are handed out; none if it is null.
What is one for all, and the nodes of this rank
Collective: all ranks ask at the same time, as many points as each wants.
as long as nobody changes its mind
failure of this rank: told to the others at the next event
The nearest first, so far as they are much nearer than the other end.
Sees to it that Kokkos runs
anyone's, all of them over all ranks
Where they lie in the domain.
On all ranks.
Is any value in the file?
""".strip().split("\n")

GOOD = """
Signed distance to the boundary of the domain.
Maps each cell to the rank that owns it.
Area of a triangle from its side lengths (Heron's formula).
`nodes` must outlive this object. `by` must not be `none`.
Repartitions when the imbalance exceeds `rebalance_above`
Inserts or deletes nodes at defects that the overlap ratio does not detect.
Decides when levels are built, advanced and finished; the components implement these steps.
Composes the warnings of a level and of a finished run. An empty string means no warning.
Coincident nodes have no star and are removed first.
Installs `level`, or clears the results if it is null.
Global state and the owned nodes of this rank
Collective. Each rank may pass a different number of points, including none.
until the partition or the lists change
Local failure; reported to the other ranks at the next event.
Sorts by distance; candidates closer to the other end are skipped.
Starts Kokkos, or adopts the instance of the host program
In any distribution over the ranks; together they must be complete
For each owned node, the elements that have it as a site, and its index among their sites.
Returns the corner of the hole that follows `node` if `from` precedes it, or -1 if there is none.
In a text file each element has its own type and tags; in a binary file a block of elements has.
If one rank fails in any step, all ranks throw.
Of equal gains, the one nearest to the surface is returned.
Where patches of different d meet, the body-centred cubic lattice relaxes better.
What follows from the domain, the spacing and the options, such as the tree, is not stored.
With 100, METIS balances to 3 %.
From here on no rank can fail, so no node is lost.
Tells apart facets with the domain on one side and on both sides.
Children come after their parents in the tree.
Updates `x` in place. This is the only place where one rank knows all nodes of its neighbours.
Calls visit(places) with the indices of the other corners, and asks(shapes) once.
""".strip().split("\n")

FILES = {
    "src/level/level.hpp": """// SPDX-License-Identifier: BSD-3-Clause
// Levels. A level owns
// its nodes. Who has
// what.
#pragma once
const char* text = "// Of what bounds the domain.";
int a;  // On all ranks.
int b;  // 1 or 2, e.g. the rank
/* Nodes that coincide go first.
 * Of a triangle. */
""",
    "src/tool/main.cpp": "// Of which?\n// ----------------\nint main() {}\n",
    "tests/core/CMakeLists.txt": "# Nobody\nproject(x) # Of what\n",
    "tests/core/notes.txt": "# Who has what.\n",
    "tests/core/test.py": "#!/usr/bin/env python3\n# Whose it is.\nx = 1\n",
    "bindings/fortran/a.f90": "!> Of this rank\n!  alone.\ninteger :: n\n",
}
FOUND = """src/level/level.hpp:3: begins with Who: Who has what.
src/level/level.hpp:7: begins with On and has no verb: On all ranks.
src/level/level.hpp:9: "go first" is an everyday phrase: Nodes that coincide go first.
src/level/level.hpp:10: begins with Of and has no main clause: Of a triangle.
src/tool/main.cpp:1: begins with Of and has no main clause: Of which?
tests/core/CMakeLists.txt:1: begins with Nobody: Nobody
tests/core/test.py:2: begins with Whose: Whose it is.
bindings/fortran/a.f90:1: begins with Of and has no main clause: Of this rank alone.""".split("\n")


def self_test():
    for comment in BAD:
        if not any(reason_against(sentence) for _, sentence in sentences(comment)):
            sys.exit(f"the check is wrong: it passes: {comment}")
    for comment in GOOD:
        for _, sentence in sentences(comment):
            if reason_against(sentence):
                sys.exit(f"the check is wrong: it finds that this {reason_against(sentence)}: {sentence}")
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        statuses = [main([name])]
        for file, text in FILES.items():
            path = root / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        found = [f"{file}:{line}: {message}" for file, line, message in findings(root)[0]]
        statuses.append(main([name]))
        for file in FILES:
            (root / file).write_text("")
        statuses.append(main([name]))
    if found != FOUND:
        sys.exit("the check is wrong: it finds\n" + "\n".join(found))
    if statuses != [1, 1, 0]:
        sys.exit(f"the check ends with {statuses} where there are no files, comments to rewrite, and none")


def main(arguments):
    return checks.main(arguments, faults, self_test)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
