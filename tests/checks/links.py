"""Every relative link of README.md and docs/*.md must lead to a file that is there, and its #anchor to a heading.

usage: links.py SOURCE_DIR
"""
import re
import sys
from pathlib import Path

LINK = re.compile(r"\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(([^()\s]+)\)")
FENCE = re.compile(r"^ *```.*?^ *```", re.M | re.S)
CODE = re.compile(r"`[^`\n]*`")


def prose(page):
    return FENCE.sub("", page.read_text(encoding="utf-8"))


def anchors(page):
    """As GitHub makes them: lower case, no punctuation, blanks become hyphens, repeated ones are numbered."""
    found = []
    for heading in re.findall(r"^#+ +(.+?) *#*$", prose(page), re.M):
        slug = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        again = sum(other == slug or re.fullmatch(re.escape(slug) + r"-\d+", other) is not None for other in found)
        found.append(f"{slug}-{again}" if again else slug)
    return found


def fault(page, link):
    """Why a link leads nowhere; empty if it does not."""
    name, _, anchor = link.partition("#")
    target = page.parent / name if name else page
    if not target.exists():
        return "no such file"
    if anchor and anchor not in anchors(target):
        return "no such heading"
    return ""


def main():
    root = Path(sys.argv[1])
    links, wrong = 0, []
    for page in [root / "README.md", *sorted((root / "docs").glob("*.md"))]:
        for link in LINK.findall(CODE.sub("", prose(page))):
            if re.match(r"[a-z]+:", link):
                continue
            links += 1
            if why := fault(page, link):
                wrong.append(f"{page.relative_to(root)}: {link}: {why}")
    if links < 50:
        wrong.append(f"only {links} links found: are they looked for?")
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"ok: {links} links")


if __name__ == "__main__":
    main()
