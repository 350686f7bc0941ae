// The look of the page: light and dark, narrow and wide, on paper too.
#pragma once

namespace warmjoint::report {

inline constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c2026; --faint: #545b66; --paper: #ffffff;
  --rule: #d9dde3; --accent: #0072b2; --soft: #f4f6f8; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8ebf0; --faint: #a8afba; --paper: #16191e;
  --rule: #3a404a; --accent: #6cb8ec; --soft: #1f242b; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 70rem; padding: 1.5rem 1rem 4rem; color: var(--ink);
  background: var(--paper); font: 1rem/1.55 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .4rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .6rem; border-bottom: 1px solid var(--rule); padding-bottom: .2rem; }
p { margin: .5rem 0; max-width: 46rem; }
.question { color: var(--faint); }
.verdict { font-size: 1.15rem; font-weight: 600; border-left: 4px solid var(--accent); padding: .2rem 0 .2rem .8rem; }
a { color: var(--accent); }
a:focus-visible, .scroll:focus-visible, summary:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; }
nav ul { list-style: none; padding: 0; display: flex; flex-wrap: wrap; gap: .2rem 1.2rem; }
.skip { position: absolute; left: -999rem; }
.skip:focus { position: static; }
.scroll { overflow-x: auto; margin: .8rem 0; background:
  linear-gradient(to right, var(--paper) 40%, transparent) left / 2rem 100% no-repeat local,
  linear-gradient(to left, var(--paper) 40%, transparent) right / 2rem 100% no-repeat local,
  linear-gradient(to right, var(--rule), transparent) left / .8rem 100% no-repeat scroll,
  linear-gradient(to left, var(--rule), transparent) right / .8rem 100% no-repeat scroll; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; white-space: nowrap; }
caption { text-align: left; color: var(--faint); padding-bottom: .3rem; }
th, td { padding: .3rem .8rem .3rem 0; text-align: right; border-bottom: 1px solid var(--rule); }
.words { text-align: left; }
.name { position: sticky; left: 0; background: var(--paper); }
tbody th { font-weight: 400; }
figure { margin: 1.4rem 0; }
img { max-width: 100%; height: auto; display: block; }
figcaption { color: var(--faint); font-size: .92rem; max-width: 46rem; }
pre { overflow-x: auto; background: var(--soft); padding: .8rem; font-size: .88rem; }
h3 { font-size: 1rem; margin: 1.2rem 0 .3rem; }
dt { font-weight: 600; margin-top: .6rem; } dd { margin-left: 1.2rem; max-width: 44rem; }
@media (max-width: 44rem) { img { max-width: none; width: 40rem; } }
@media print { nav, .skip { display: none; } figure { break-inside: avoid; } }
)";

}  // namespace warmjoint::report
