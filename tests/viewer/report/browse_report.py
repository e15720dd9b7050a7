#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens a report in Chromium, as a double click would, and uses it as a person would: mouse and keys.

usage: browse_report.py REPORT.html
Prints what is wrong, a line each; exit code 1 if anything is, 77 where there is no Chromium. No display is needed.

Chromium is steered by its DevTools protocol over a pipe: JSON messages that end in a zero byte, requests through file
descriptor 3, answers and events through 4.
"""
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TIMEOUT_S = 60


class Browser:
    def __init__(self, program, profile):
        to_child, self._write = os.pipe()
        self._read, from_child = os.pipe()

        def connect():  # via high numbers, since the pipes' own may be 3 and 4
            os.dup2(to_child, 103), os.dup2(from_child, 104)
            os.dup2(103, 3), os.dup2(104, 4)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--remote-debugging-pipe",
             "--disable-background-networking", f"--user-data-dir={profile}", "about:blank"],
            preexec_fn=connect, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_child), os.close(from_child)
        self._answers, self._buffer, self._count, self._session = {}, b"", 0, None
        self.events = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def close(self):
        self._session = None
        self.call("Browser.close")
        self.process.wait(TIMEOUT_S)

    def _receive(self):
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._read], [], [], TIMEOUT_S)
            received = ready and os.read(self._read, 1 << 20)
            if not received:
                raise RuntimeError("Chromium ended or hangs")
            self._buffer += received
        message, self._buffer = self._buffer.split(b"\0", 1)
        message = json.loads(message)
        if "id" in message:
            self._answers[message["id"]] = message
        else:
            self.events.append(message)

    def call(self, method, **params):
        self._count += 1
        number = self._count
        message = {"id": number, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        while number not in self._answers:
            self._receive()
        answer = self._answers.pop(number)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']}")
        return answer["result"]

    def heard(self, method):
        return [event["params"] for event in self.events if event["method"] == method]

    def open(self, url):
        self.events.clear()
        self.call("Page.navigate", url=url)
        while not self.heard("Page.loadEventFired"):
            self._receive()

    def resize(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def box(self, selector):
        """The element in the middle of the window, as x, y, width, height in the window."""
        return self.value(f"""(() => {{ const e = document.querySelector({json.dumps(selector)});
            e.scrollIntoView({{block: 'center'}}); const r = e.getBoundingClientRect();
            return [r.x, r.y, r.width, r.height]; }})()""")

    def mouse(self, kind, x, y):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1, clickCount=1)

    def drag(self, selector, start, end):
        """From and to fractions of the element's width."""
        x, y, width, height = self.box(selector)
        middle = y + height / 2
        self.mouse("mousePressed", x + start * width, middle)
        for step in range(1, 6):
            self.mouse("mouseMoved", x + (start + (end - start) * step / 5) * width, middle)
        self.mouse("mouseReleased", x + end * width, middle)

    def click(self, selector):
        self.drag(selector, 0.5, 0.5)

    def press(self, key, code):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code,
                      **({"text": key} if len(key) == 1 and kind == "keyDown" else {}))

    def shot(self, selector):
        """What is to be seen of an element, as the bytes of a PNG."""
        x, y, width, height = self.box(selector)
        clip = {"x": x + self.value("scrollX"), "y": y + self.value("scrollY"), "width": width, "height": height, "scale": 1}
        return self.call("Page.captureScreenshot", clip=clip)["data"]


faults = []


def check(what, true):
    if not true:
        faults.append(what)


def check_page(browser, state):
    """What holds however the page is shown: nothing missing, nothing strange in it, nothing wider than the window."""
    pictures = browser.value("[...document.images].map(i => i.complete && i.naturalWidth > 0)")
    check(f"{state}: {len(pictures)} pictures, too few", len(pictures) >= 8)
    check(f"{state}: a picture did not load", all(pictures))
    check(f"{state}: a picture has no text for those who cannot see it", browser.value(
        "[...document.images, ...document.querySelectorAll('svg')].every(i => i.alt || i.ariaLabel)"))
    check(f"{state}: foreign elements", browser.value(
        "document.scripts.length === 1 && !document.querySelector('iframe, object, embed, link, base, form, a')"))
    check(f"{state}: an event handler in the markup", not browser.value(
        "[...document.querySelectorAll('*')].some(e => e.getAttributeNames().some(n => n.startsWith('on')))"))
    for width in (1280, 600, 320):
        browser.resize(width, 800)
        check(f"{state}: wider than a window of {width}",
              browser.value("document.documentElement.scrollWidth <= document.documentElement.clientWidth"))
    browser.resize(1280, 800)


def check_silence(browser, state):
    for call in browser.heard("Runtime.consoleAPICalled"):
        faults.append(f"{state}: console.{call['type']}")
    for error in browser.heard("Runtime.exceptionThrown"):
        faults.append(f"{state}: {error['exceptionDetails']['text']}")
    for entry in browser.heard("Log.entryAdded"):
        faults.append(f"{state}: {entry['entry']['text']}")
    asked = [request["request"]["url"] for request in browser.heard("Network.requestWillBeSent")]
    check(f"{state}: not one request for the page was heard", any(url.startswith("file:") for url in asked))
    for url in asked[1:]:
        check(f"{state}: asks for {url[:100]}", url.startswith("data:"))


def check_pair(browser):
    shown = "[...document.querySelector('.pair').querySelectorAll('figure')].map(f => getComputedStyle(f).visibility).join()"
    side_by_side = browser.shot(".pair .stage")
    range_says = "[document.querySelector('.cover input').value / 10 + '%', document.querySelector('.cover input').ariaValueText]"

    # A bare letter is a shortcut within the pair alone: elsewhere it may be what speech or a slip of the hand types.
    says_key = "getComputedStyle(document.querySelector('.pair .flip kbd')).visibility === 'visible'"
    browser.value("document.activeElement.blur()")
    browser.press("f", 70)
    check("flip: F flips what has no focus", browser.shot(".pair .stage") == side_by_side)
    check("flip: the button names a key that does nothing", not browser.value(says_key))
    for inside in ("input[type=radio]", ".flip"):
        browser.value(f"document.querySelector('.pair {inside}').focus()")
        check(f"flip: the button does not name its key, with focus on {inside}", browser.value(says_key))
        browser.press("f", 70)
        check(f"flip: F does nothing with focus on {inside}", browser.value(shown) == "visible,hidden")
        browser.click(".pair label:nth-of-type(1)")
    check("flip: its key is not in the markup", browser.value(
        "[...document.querySelectorAll('.pair .flip')].every(b => b.getAttribute('aria-keyshortcuts') === 'F')"))

    browser.click(".pair label:nth-of-type(2)")
    check("swipe: the button shows no slider", browser.value("document.querySelector('.cover').offsetHeight > 100"))
    check("swipe: the slider does not say where it stands", browser.value(range_says) == ["50%", "50%"])
    half = browser.shot(".pair .cover")
    check("swipe: looks like side by side", half != side_by_side)
    browser.drag(".pair .cover", 0.5, 0.2)
    at = int(browser.value("document.querySelector('.cover input').value"))
    check(f"swipe: dragged to a fifth, the slider stands at {at} of 1000", abs(at - 200) <= 10)
    fifth = browser.shot(".pair .cover")
    check("swipe: dragging changes nothing to be seen", fifth != half)
    browser.press("ArrowRight", 39)
    check("swipe: an arrow key does not move the slider",
          int(browser.value("document.querySelector('.cover input').value")) > at)
    check("swipe: an arrow key changes nothing to be seen", browser.shot(".pair .cover") != fifth)
    check("swipe: the slider does not say where an arrow key put it", len(set(browser.value(range_says))) == 1)

    browser.press("f", 70)
    check("flip: F does not show the left picture", browser.value(shown) == "visible,hidden")
    first = browser.shot(".pair .stage img")
    browser.press("f", 70)
    check("flip: F again does not show the right picture", browser.value(shown) == "hidden,visible")
    second = browser.shot(".pair .stage img")
    check("flip: both pictures look alike", first != second)
    browser.click(".pair button.flip")
    check("flip: the button does not go back to the left picture", browser.shot(".pair .stage img") == first)
    browser.click(".pair .stage img")
    check("flip: a click does not show the right picture", browser.shot(".pair .stage img") == second)
    browser.value("document.activeElement.blur()")
    browser.click(".pair .stage img")
    browser.press("f", 70)
    check("flip: F does nothing behind a click on the picture", browser.shot(".pair .stage img") == second)

    browser.click(".pair label:nth-of-type(1)")
    check("side by side: does not come back", browser.shot(".pair .stage") == side_by_side)


def check_steps(browser):
    shown = "[...document.querySelectorAll('.steps li')].map(i => Number(i.offsetHeight > 0)).join('')"
    check("steps: does not begin with the first alone", browser.value(shown) == "1000")
    browser.click(".steps .next")
    check("steps: Next does not show the second", browser.value(shown) == "0100")
    browser.click(".steps label:nth-of-type(4)")
    check("steps: its button does not show the fourth", browser.value(shown) == "0001")
    browser.press("ArrowLeft", 37)
    check("steps: an arrow key does not show the third", browser.value(shown) == "0010")
    browser.click(".steps .back")
    check("steps: Back does not show the second", browser.value(shown) == "0100")


def check_choice(browser):
    """A select box shows another picture in the pair, with its name."""
    side = "document.querySelector('.pair figure:nth-of-type(2)')"
    shown = f"[{side}.querySelector('img').src, {side}.textContent]"
    before = browser.value(shown)
    browser.value("document.querySelector('.pair select[data-side=right]').focus()")
    browser.press("Home", 36)
    after = browser.value(shown)
    check("choice: a key in the select box changes no picture", after[0] != before[0])
    check("choice: the caption is not the choice's name", after[1] == browser.value(
        "document.querySelector('.pair select[data-side=right]').options[0].label"))
    browser.press("End", 35)
    check("choice: a picture of the page is not what is shown", browser.value(
        f"document.getElementById(document.querySelector('.pair select[data-side=right]').value).src === {side}.querySelector('img').src"))


def check_plot(browser):
    """The marks of a plot show their pictures: under the mouse, and by the arrow keys."""
    panel = "document.querySelector('.pointed')"
    shown = f"[{panel}.querySelector('p').textContent, ...[...{panel}.querySelectorAll('img')].map(i => i.src)]"
    marks = browser.value("document.querySelector('.explore').querySelectorAll('.mark').length")
    check("plot: not one stop for the Tab key", browser.value(
        "document.querySelector('.explore').querySelectorAll('.mark[tabindex=\"0\"]').length") == 1)
    browser.value("document.querySelector('.mark[tabindex=\"0\"]').focus()")
    seen = []
    for _ in range(marks):
        browser.press("ArrowRight", 39)
        words, *pictures = browser.value(shown)
        check("plot: a focused mark does not say what it is",
              words and words == browser.value("document.activeElement.querySelector('title').textContent"))
        check(f"plot: a focused mark shows {len(pictures)} pictures, not two", len(pictures) == 2)
        seen.append(words)
    check("plot: the arrow keys do not reach every mark", len(set(seen)) == marks)
    check("plot: its pictures are not to be seen", browser.value(
        f"[...{panel}.querySelectorAll('img')].every(i => i.naturalWidth > 0 && i.offsetHeight > 50)"))
    focused = browser.value(shown)
    other = browser.value("""(() => { const marks = [...document.querySelector('.explore').querySelectorAll('.mark')];
        const free = marks.find(m => { const r = m.querySelector('.shape').getBoundingClientRect();
            return m !== document.activeElement &&
                   m.contains(document.elementFromPoint(r.x + r.width / 2, r.y + r.height / 2)); });
        const r = free.querySelector('.shape').getBoundingClientRect();
        return [r.x + r.width / 2, r.y + r.height / 2, free.querySelector('title').textContent]; })()""")
    browser.mouse("mouseMoved", other[0], other[1])
    check("plot: a mark under the mouse does not show its pictures", browser.value(shown)[0] == other[2])
    check("plot: a mark under the mouse shows those of another", browser.value(shown) != focused)


def check_table(browser):
    """A click on a heading sorts a table up, the next one down; a number counts as such."""
    column = "[...document.querySelector('table.sortable').tBodies[0].rows].map(r => parseFloat(r.cells[2].textContent))"
    heading = "table.sortable thead th:nth-child(3)"
    unsorted = browser.value(column)
    browser.click(heading + " button")
    check("table: a click does not sort upwards", browser.value(column) == sorted(unsorted))
    check("table: does not say that it is sorted upwards", browser.value(
        f"document.querySelector('{heading}').getAttribute('aria-sort')") == "ascending")
    browser.press(" ", 32)
    check("table: the space bar does not sort downwards", browser.value(column) == sorted(unsorted, reverse=True))
    check("table: does not say that it is sorted downwards", browser.value(
        f"document.querySelector('{heading}').getAttribute('aria-sort')") == "descending")
    browser.click("table.sortable thead th:nth-child(1) button")
    names = browser.value("[...document.querySelector('table.sortable').tBodies[0].rows].map(r => r.cells[0].textContent)")
    check("table: names are not sorted", names == browser.value(f"{json.dumps(names)}.sort((a, b) => a.localeCompare(b))"))
    check("table: two columns claim to be sorted", browser.value(
        "document.querySelector('table.sortable').querySelectorAll('[aria-sort]').length") == 1)


def check_keyboard(browser, names):
    """Everything that can be used is reached by the Tab key, and says so."""
    browser.value("document.activeElement.blur()")
    reached = []
    for _ in range(12):
        browser.press("Tab", 9)
        reached.append(browser.value(
            "document.activeElement.getAttribute('class') || document.activeElement.name || document.activeElement.dataset.side"))
    for name in names:
        check(f"keyboard: Tab does not reach {name}, only {reached}", any(name in (each or "").split() for each in reached))
    browser.value("document.querySelector('button').focus()")
    browser.press("Tab", 9)
    check("keyboard: focus is not to be seen",
          browser.value("getComputedStyle(document.activeElement).outlineStyle") == "solid")


def main():
    program = shutil.which("chromium")
    if not program:
        print("skipped: no chromium")
        return 77
    url = Path(sys.argv[1]).resolve().as_uri()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(program, profile)
        browser.resize(1280, 800)
        browser.open(url)
        check_page(browser, "as it is")
        if browser.value("!!document.querySelector('.explore')"):   # a bench's
            check_keyboard(browser, ("mark", "pair-0", "flip", "left", "right", "wide"))
            check_plot(browser)
            check_choice(browser)
            check_table(browser)
        else:                                                         # a comparison's
            check_keyboard(browser, ("pair", "flip", "ledger", "back", "next"))
            check_steps(browser)
        check_pair(browser)
        check_silence(browser, "as it is")

        # That silence means something: a request is refused by the page's own policy, and heard of here.
        browser.value("new Image().src = 'http://127.0.0.1:9/'; new Promise(done => setTimeout(done, 200))")
        check("the page's policy lets a request out", any(
            "Content Security Policy" in json.dumps(event) for event in browser.events))

        browser.call("Emulation.setScriptExecutionDisabled", value=True)
        browser.open(url)
        check_page(browser, "without JavaScript")
        check("without JavaScript: a picture is hidden", browser.value(
            "[...document.images].every(i => i.offsetHeight > 0 && getComputedStyle(i).visibility === 'visible')"))
        check("without JavaScript: a control that does nothing", browser.value(
            "[...document.querySelectorAll('input, button, select')].every(i => i.offsetHeight === 0)"))
        check_silence(browser, "without JavaScript")
        browser.close()
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
