//! Grids of settings: a scene or a problem family at every point.
//!
//! A grid file ([`Grid`]) defines what varies; its [`Plan`] numbers the points. Each point is an
//! independent task, for any thread or machine ([`measure`](mod@measure)); a [`Folder`] stores the
//! results, and `collect` combines them, bitwise identical regardless of how they were computed.
//!
//! ```toml
//! title = "A block on a slope"
//! text = "What the page says above the figures."
//! scene = "incline"               # a shipped scene or a file; or: family = "stack"
//! steps = 50                      # for a scene; by default its own count
//! measure = ["drift", "iterations"] # measures to draw; all measures are recorded
//! seed = 1                        # of all that is random
//! repeat = 3                      # runs per point, each with its own seed
//!
//! [set]                           # the same in all tasks
//! solver.name = "sor"
//!
//! [axes]                          # all combinations; the first one is the horizontal axis
//! solver.omega = { from = 1.0, to = 1.9, count = 10 }
//! bodies.block.mass = { from = 1.0, to = 100.0, count = 3, spacing = "log" }
//! step.scheme = ["velocity", "acceleration"]
//!
//! [zip]                           # lists of equal length that vary together, as one more axis
//! step.dt = [0.01, 0.005]
//! step.count = [50, 100]
//!
//! [labels]                        # names of settings on the page
//! solver.omega = "ω"
//! ```
//!
//! `scale = "linear"` or `"log"` sets the scale of the measures' axis, which otherwise depends on
//! the values; `limit` is a value of the first measure that is good enough; `theory` names a
//! closed form to draw for comparison ([`Theory`]). The measure `rate`
//! solves the problem once more.
//!
//! A setting is the path of a field in the scene file, as for `simulate --set`; items of a list are
//! given by their number from 0 or their name. For a family it is a parameter, or a field of
//! `solver` as in scenes. `scene`, `family` and `steps` can be axes themselves. A family's
//! problem is solved once, from 0.
//!
//! Random values use a seed of the task, which is derived from `seed`, the repetition, and the
//! settings that define the problem: tasks that differ only in `solver` or `step` get the same
//! problem.

mod collect;
mod file;
mod folder;
pub mod measure;
mod page;
mod plan;
mod subject;
mod theory;

pub use collect::{Collection, Point, collect};
pub use file::{Axis, Grid};
pub use folder::{Folder, Machine, Record};
pub use measure::Finding;
pub use page::plan_table;
pub(crate) use page::show_seconds;
pub use page::{document, show, text};
pub use plan::{Plan, Task};
pub use theory::{Predicted, Theory};
