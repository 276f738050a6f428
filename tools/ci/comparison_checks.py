"""Checks of the page that compare --report writes, a part of tools/ci/check_report."""
import json
import pathlib
import subprocess

from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

from page_checks import PIXELS, check_paper, check_quiet, expect, expect_that, texts, visit

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "colmap-vcarve"
ROOM = ROOT / "fixtures" / "room"


def pictures(browser):
    """The hashes of the images of all views."""
    count = browser.execute_script("return window.report.panes.length")
    return [browser.execute_script(PIXELS, i)[0] for i in range(count)]


def check_all_change(browser, what, action, views=None):
    """Checks that an action changes these views, by default all."""
    before = pictures(browser)
    action()
    after = pictures(browser)
    for i in range(len(before)) if views is None else views:
        expect_that(after[i] != before[i], f"{what} changes no pixel of view {i}")


def canvases(browser):
    return browser.find_elements(By.CSS_SELECTOR, "#panes canvas")


def check_views(browser, count):
    """Checks that there are `count` views with different images."""
    expect(len(canvases(browser)), count, "canvases")
    for i in range(count):
        expect_that(browser.execute_script(PIXELS, i)[1] > 5, f"canvas {i} is blank")
    expect(len(set(pictures(browser))), count, "pictures that differ")


def check_linked(browser):
    for i, canvas in enumerate(canvases(browser)):
        hand = webdriver.ActionChains(browser).drag_and_drop_by_offset(canvas, 40, 20)
        check_all_change(browser, f"dragging in view {i}", hand.perform)
        check_all_change(browser, f"a key in view {i}", lambda c=canvas: c.send_keys("-"))
        check_all_change(browser, f"] in view {i}", lambda c=canvas: c.send_keys("]"))
    frames = browser.find_elements(By.CSS_SELECTOR, "#panes .image-frame")
    expect([frame.is_displayed() for frame in frames], [True] * len(frames), "frames of the image")
    check_all_change(browser, "Overview", browser.find_element(
        By.CSS_SELECTOR, "[data-go=overview]").click)


def check_colors(browser, scale, title):
    color = Select(browser.find_element(By.ID, "color"))
    legend = browser.find_element(By.ID, "legend")
    expect(color.first_selected_option.get_attribute("value"), "distance", "the first color")
    expect_that(title in legend.text, f"the legend is {legend.text!r}, expected {title!r}")
    expect(texts(browser, "#legend .ends span"),
           ["0", f"{50 * scale:g} %", f"{100 * scale:g} % or more"], "the ends of the legend")
    # The truth has no distance to itself, and no colors.
    meshes = (0, 1)
    for option in ("plain", "rgb", "normal", "distance"):
        check_all_change(browser, f"color {option}", lambda o=option: color.select_by_value(o),
                         meshes)
        expect(legend.is_displayed(), option in ("normal", "distance"), f"a legend of {option}")


def check_layers(browser):
    for button in browser.find_elements(By.CSS_SELECTOR, "[data-layer]"):
        # The truth is closed: it shows no backs, and hides the cameras inside.
        views = {"backs": (0,), "cameras": (0, 1)}.get(button.get_attribute("data-layer"))
        check_all_change(browser, button.text, button.click, views)
        check_all_change(browser, f"{button.text} again", button.click, views)


def check_surfaces(browser, count):
    buttons = browser.find_elements(By.CSS_SELECTOR, "#surfaces button")
    buttons[0].click()
    expect(len(canvases(browser)), count - 1, "canvases without the first surface")
    buttons[0].click()
    check_views(browser, count)
    places = browser.execute_script("return window.report.panes.map((pane) => "
                                    "pane.view.state.position.toArray())")
    expect(places, places[:1] * count, "places of the cameras")


def check_places(browser, scene):
    listed = [place for surface in scene["surfaces"] for kind in ("missing", "wrong")
              for place in surface[kind] or []]
    buttons = browser.find_elements(By.CSS_SELECTOR, "#places button")
    expect_that(len(listed) > 4, "too few worst places")
    expect(len(buttons), len(listed), "worst places")
    shares = [float(button.text.split()[0]) for button in buttons]
    for share, place in zip(shares, listed):
        expect_that(abs(share - 100 * place["distance"]) <= max(0.5, 0.05 * share),
                    f"a place is {share} % off, but the page says {place['distance']}")
    goes = [buttons[0].click, buttons[-1].click, lambda: buttons[1].send_keys(Keys.ENTER)]
    for number, (button, go) in enumerate(zip((buttons[0], buttons[-1], buttons[1]), goes)):
        check_all_change(browser, f"worst place {number}", go)
        expect(button.get_attribute("aria-pressed"), "true", f"place {number} is chosen")
        rings = browser.find_elements(By.CSS_SELECTOR, "#panes .ring")
        expect([ring.is_displayed() for ring in rings], [True] * len(rings), "rings around it")
        expect_that(button.text.split()[0] in browser.find_element(By.ID, "place-text").text,
                    "the text of a place does not have its distance")
    expect(len(browser.find_elements(By.CSS_SELECTOR, "#places [aria-pressed=true]")), 1,
           "chosen places")


def at_place(mesh, place):
    for key in place.split("/")[1:]:
        mesh = mesh[int(key)] if isinstance(mesh, list) else mesh[key]
    return mesh


def check_numbers(browser, figures, table):
    """Checks the table: words as in the terminal, numbers as in the file of --json."""
    lines = [[cell.strip() for cell in line.strip("|\n").split("|")]
             for line in table.splitlines() if line.startswith("|")]
    rows = browser.execute_script(
        "return Array.from(document.querySelectorAll('#table tr'), (row) => Array.from(row.cells, "
        "(cell) => cell.textContent))")
    expect(rows[0][1:], lines[0][1:], "the meshes' names")
    expect(rows[1:], lines[2:], "the table")
    shown = browser.execute_script(
        "return Array.from(document.querySelectorAll('#table tbody tr'), (row) => "
        "[row.dataset.place, Array.from(row.cells).slice(1).map((cell) => cell.title)])")
    for place, titles in shown:
        expect([float(title) if title else None for title in titles],
               [at_place(mesh, place) for mesh in figures["meshes"]], place)
    expect(texts(browser, "#definitions li"), figures["definitions"], "definitions")
    expect_that("\n".join(figures["definitions"]) in table, "the definitions differ from the terminal")


def check_layout(browser, width, scheme):
    check_paper(browser, width, scheme)
    boxes = [canvas.rect for canvas in canvases(browser)]
    same = "y" if width > 700 else "x"
    expect(len({box[same] for box in boxes}), 1, f"{same} of the canvases at {width}")
    expect(len({box["x" if same == "y" else "y"] for box in boxes}), len(boxes), "their places")


def make_comparison(folder, name, meshes, *options):
    page, figures = folder / f"{name}.html", folder / f"{name}.json"
    words = [PROGRAM, "compare", "--quiet", ROOM, *meshes, *options, "--samples", "20000",
             "--report", page, "--json", figures]
    table = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return page, json.loads(figures.read_text(encoding="utf-8")), table


def check(browser, folder):
    """Checks a wide page with ground truth, and a page on a phone with three meshes."""
    ours, strict, odd = (folder / name for name in ("ours.ply", "strict.ply",
                                                    "<img src=x onerror=broken()>&lt;.ply"))
    for mesh, *options in ((ours,), (strict, "--method", "strict"), (odd, "--simplify", "300")):
        subprocess.run([PROGRAM, "--quiet", ROOM, mesh, *options], check=True)
    page, figures, table = make_comparison(folder, "wide", (ours, strict), "--truth",
                                           ROOM / "truth.ply")
    visit(browser, page, 1400, 900, "light")
    scene = browser.execute_script("return JSON.parse(document.getElementById('scene').textContent)")
    check_views(browser, 3)
    check_numbers(browser, figures, table)
    expect_that(str(page) in texts(browser, "#command")[0], "the command does not name the page")
    check_layout(browser, 1400, "light")
    check_colors(browser, scene["scale"], "Distance to the truth, in % of its diagonal")
    check_linked(browser)
    check_layers(browser)
    check_surfaces(browser, 3)
    check_places(browser, scene)
    check_quiet(browser, page)

    page, figures, table = make_comparison(folder, "narrow", (ours, strict, odd))
    visit(browser, page, 390, 844, "dark")
    check_views(browser, 3)
    check_numbers(browser, figures, table)
    check_layout(browser, 390, "dark")
    box = browser.execute_script("const box = document.querySelector('.scroll'); "
                                 "return [box.scrollWidth, box.clientWidth]")
    expect_that(box[0] > box[1], "the table of three meshes does not scroll on a phone")
    expect(len(browser.find_elements(By.TAG_NAME, "img")), 0, "images in the page")
    expect_that(odd.name in texts(browser, "#surfaces button"), "a name is not shown as it is")
    check_all_change(browser, "a place on a phone", browser.find_element(
        By.CSS_SELECTOR, "#places button").click)
    check_quiet(browser, page)
