/* SPDX-License-Identifier: MIT */
/* The table of results: sorting, filtering, choosing a method. */

const results = document.getElementById("results");

/* Numbers by their data-value, the rest as text; what has no value comes last either way. */
function sortRows(column, descending) {
  const body = results.tBodies[0], value = row => {
    const cell = row.cells[column];
    return cell.dataset.value !== undefined ? +cell.dataset.value : cell.textContent === "–" ? null : cell.textContent;
  };
  const rows = [...body.rows].sort((r, s) => {
    const a = value(r), b = value(s);
    if (a === null || b === null)
      return (a === null) - (b === null);
    const order = typeof a === "number" ? a - b : String(a).localeCompare(String(b));
    return descending ? -order : order;
  });
  body.replaceChildren(...rows);
  [...results.tHead.rows[0].cells].forEach((cell, i) => {
    if (i === column)
      cell.setAttribute("aria-sort", descending ? "descending" : "ascending");
    else
      cell.removeAttribute("aria-sort");
  });
  markGroups();
}

/* A rule above each scene, as long as the scenes stand together. */
function markGroups() {
  let before = null, groups = 0;
  const rows = [...results.tBodies[0].rows].filter(row => !row.hidden), scenes = new Set(rows.map(row => row.dataset.scene)).size;
  rows.forEach(row => { groups += row.dataset.scene !== before; before = row.dataset.scene; });
  before = rows.length ? rows[0].dataset.scene : null;
  for (const row of rows) {
    row.classList.toggle("first", groups === scenes && row.dataset.scene !== before);
    before = row.dataset.scene;
  }
}

function filterRows(scene) {
  for (const row of [...results.tBodies[0].rows, ...(results.tFoot ? results.tFoot.rows : [])])
    row.hidden = scene !== "" && row.dataset.scene !== scene;
  markGroups();
}

function markChosen() {
  for (const row of results.tBodies[0].rows)
    row.classList.toggle("chosen", +row.dataset.method === state.a - 1 && +row.dataset.scene === state.scene.index);
}

function prepareTable() {
  [...results.tHead.rows[0].cells].forEach((cell, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = cell.textContent;
    button.addEventListener("click", () => sortRows(column, cell.getAttribute("aria-sort") === "ascending"));
    cell.replaceChildren(button);
  });
  for (const row of results.tBodies[0].rows) {
    const cell = row.cells[1], button = document.createElement("button");
    button.type = "button";
    button.textContent = cell.textContent;
    button.addEventListener("click", () => {
      if (+row.dataset.scene >= 0)
        setScene(+row.dataset.scene);
      setPictures(+row.dataset.method + 1, state.b);
    });
    cell.replaceChildren(button);
  }
  const scenes = document.getElementById("table-scene");
  scenes.append(new Option("all", ""), ...report.scenes.map(s => new Option(s.name, s.index)));
  if (report.scenes.length > 1)
    scenes.append(new Option("mean over scenes", "-1"));
  scenes.addEventListener("change", () => filterRows(scenes.value));
  const every = document.getElementById("table-all"), show = () => results.classList.toggle("compact", !every.checked);
  every.addEventListener("change", show);
  show();
  markGroups();
}
