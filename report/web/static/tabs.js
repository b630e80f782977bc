// Tabs by the pattern of the ARIA guide: arrow keys, Home and End choose, the panel follows.

/** Make a list of tabs work; `opened` gets the id of the panel. */
export function mountTabs(list, opened) {
  const tabs = [...list.querySelectorAll("[role=tab]")];
  const open = (chosen) => {
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", String(tab === chosen));
      tab.tabIndex = tab === chosen ? 0 : -1;
      panel(tab).hidden = tab !== chosen;
    }
    opened(panel(chosen).id);
  };
  list.addEventListener("click", ({ target }) => {
    const tab = target.closest("[role=tab]");
    if (tab) open(tab);
  });
  list.addEventListener("keydown", (event) => {
    const next = tabs[destination(event.key, tabs.indexOf(document.activeElement), tabs.length)];
    if (!next) return;
    event.preventDefault();
    next.focus();
    open(next);
  });
}

function panel(tab) {
  return document.getElementById(tab.getAttribute("aria-controls"));
}

/** Return the index that a key goes to from another, around the ends; -1 if it is no such key. */
export function destination(key, from, count) {
  const to = { ArrowRight: (from + 1) % count, ArrowLeft: (from + count - 1) % count, Home: 0, End: count - 1 };
  return to[key] ?? -1;
}
