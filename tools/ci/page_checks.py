"""Common checks of pages, in a headless browser."""
import json

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

# A hash of the image of a view, and its number of colors. Draws and reads in one task, because
# WebGL discards an image after it is shown. A comparison has several views, numbered from 0.
PIXELS = """
const pane = window.report.panes[arguments[0] || 0];
pane.view.draw();
const from = pane.root.querySelector('canvas');
const to = document.createElement('canvas');
to.width = from.width; to.height = from.height;
to.getContext('2d').drawImage(from, 0, 0);
const bytes = to.getContext('2d').getImageData(0, 0, to.width, to.height).data;
let hash = 0;
const colors = new Set();
for (let i = 0; i < bytes.length; i += 4) {
  const color = bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2];
  hash = hash * 31 + color | 0;
  colors.add(color);
}
return [hash, colors.size];
"""

faults = []


def expect(found, wanted, what):
    if found != wanted:
        faults.append(f"{what}: found {found!r}, expected {wanted!r}")


def expect_that(holds, what):
    if not holds:
        faults.append(what)


def open_browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
                     "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--force-device-scale-factor=1"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def visit(browser, page, width, height, scheme):
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 700})
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "features": [{"name": "prefers-color-scheme", "value": scheme}]})
    browser.get(page.as_uri())
    expect(browser.execute_script("return document.documentElement.dataset.ready"), "yes",
           f"{page.name} is ready")


def check_quiet(browser, page):
    """Checks that there are no console messages and no requests other than the page."""
    expect([entry["message"] for entry in browser.get_log("browser")], [],
           f"{page.name}: messages of the console")
    messages = [json.loads(entry["message"])["message"] for entry in
                browser.get_log("performance")]
    asked = {message["params"]["request"]["url"] for message in messages
             if message["method"] == "Network.requestWillBeSent"}
    asked = {url for url in asked if not url.startswith("data:")}
    expect(asked, {page.as_uri()}, f"{page.name}: requests")


def check_changes(browser, what, action):
    before = browser.execute_script(PIXELS)[0]
    action()
    expect_that(browser.execute_script(PIXELS)[0] != before, f"{what} changes no pixel")


def texts(browser, selector):
    return browser.execute_script(
        "return Array.from(document.querySelectorAll(arguments[0]), (e) => e.textContent)",
        selector)


def check_paper(browser, width, scheme):
    """Checks that the page fits the screen, and that it is light or dark as requested."""
    expect_that(browser.execute_script("return document.documentElement.scrollWidth") <= width,
                f"the page is wider than {width}")
    paper = browser.execute_script("return getComputedStyle(document.body).backgroundColor")
    light = sum(int(part) for part in paper[4:-1].split(",")) > 384
    expect(light, scheme == "light", f"the paper is light with the scheme {scheme}")
