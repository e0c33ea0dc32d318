"use strict";
/* What all pages share. */

const byId = (id) => document.getElementById(id);

/* An element with attributes, or properties where it has some of that name, and children. */
function html(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, v] of Object.entries(attributes)) key in made && key !== "list" ? (made[key] = v) : made.setAttribute(key, v);
  made.append(...children);
  return made;
}

