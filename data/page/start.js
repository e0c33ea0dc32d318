start().catch((error) => {
  byId("summary").textContent = "";
  byId("trouble").hidden = false;
  byId("trouble").textContent = `Nothing can be shown: ${error.message}.`;
  document.body.dataset.ready = "no";
});
