// Stability (stability.js, which the page of `touchstone stability` has as well).
if (report.stability) drawStability(byId('stability'), report.stability);
byId('stability').hidden = !report.stability;
