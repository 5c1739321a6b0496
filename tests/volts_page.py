"""Holds the page of the way from volts to friction, as a browser left it, to its summary.

usage: volts_page.py PAGE SUMMARY
"""
import json
import re
import sys


def check(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


def main():
    page = open(sys.argv[1], encoding="utf-8").read()
    summary = json.load(open(sys.argv[2], encoding="utf-8"))
    friction = summary["friction"]
    told = re.search(r"<dt>friction coefficient</dt><dd>([\d.e+-]+) ± ([\d.e+-]+)</dd>", page)
    check(told and abs(float(told[1]) / friction["value"] - 1) < 1e-3, "the friction coefficient")
    check(abs(float(told[2]) / friction["error"] - 1) < 0.1, "its uncertainty")
    bars = re.findall(r'<rect class="bar" x="210" y="[\d.]+" width="([\d.]+)"', page)
    shares = [c["share"] for c in friction["contributions"].values() if c["share"] > 0 or c["linear"] > 0]
    check(len(bars) == len(shares), f"{len(bars)} bars for {len(shares)} contributions")
    unit = max(map(float, bars)) / max(shares)
    for wide, share in zip(map(float, bars), shares):
        check(abs(wide - max(0.5, unit * share)) < 0.2, f"a bar of {wide} for {share}")
    marks = len(re.findall(r'<circle class="mark" cx="-?\d', page))
    # loops and pull-off against load; pull-offs of both force curves; W and Delta of ten loops on slopes
    check(marks == len(summary["loops"]) + 1 + 2 + 2 * 10, f"{marks} marks")


if __name__ == "__main__":
    main()
