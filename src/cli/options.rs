//! The options of solvers, and which solvers use them.
//!
//! All solvers use `--tolerance` and `--max-iterations`. The [`Choices`] are used by some: giving
//! one that no solver of the command uses is a usage error, because a setting without effect is
//! misleading. If several solvers run, it applies to those that use it, and a note names them if
//! they are not all.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Args};
use lcplab::error::{Defects, Error, Result};
use lcplab::judge::Demand;
use lcplab::lcp::friction::Model;
use lcplab::memory::Memory;
use lcplab::scene::RowOrder;
use lcplab::solver::{Choice, Damping, Entry, Method, Options, Registry, Settings};

use super::limits::MemoryLimit;
use super::say;

/// The settings of a solver.
#[derive(Debug, Args)]
pub struct SolverArgs {
    /// Largest scaled residual of an accepted answer
    #[arg(long, allow_negative_numbers = true, default_value = "1e-8")]
    tolerance: f64,
    /// Maximum number of sweeps or pivots
    #[arg(long, visible_alias = "sweeps", allow_negative_numbers = true, value_parser = iterations, default_value_t = Settings::default().max_iterations)]
    max_iterations: usize,
    #[command(flatten)]
    memory: MemoryLimit,
    #[command(flatten)]
    choices: Choices,
}

/// Options that only some solvers use; one that no solver of the command uses is an error.
#[derive(Debug, Clone, Copy, Args)]
pub struct Choices {
    /// Relaxation factor of sor and ssor, above 0 and below 2 [default: 1.3]
    #[arg(long, allow_negative_numbers = true)]
    pub omega: Option<f64>,
    /// Order of the rows in a sweep of pgs and sor [default: natural]
    #[arg(long, value_parser = row_order())]
    pub order: Option<RowOrder>,
    /// Seed of --order shuffled [default: 1]
    #[arg(long)]
    pub seed: Option<u64>,
    /// Damping factor of jacobi, above 0 and below 2 [default: a value for which jacobi converges
    /// for every semidefinite A]
    #[arg(long, allow_negative_numbers = true)]
    pub damping: Option<f64>,
}

/// A number of iterations.
pub fn iterations(text: &str) -> std::result::Result<usize, String> {
    text.parse().map_err(|_| "must be a whole number, such as 1000".to_string())
}

/// An option with another default in its help: in some commands the default is another one.
pub fn with_default(option: Arg, default: &str) -> Arg {
    let help = option.get_help().map(ToString::to_string).unwrap_or_default();
    let text = help.split(" [default:").next().unwrap_or_default();
    option.help(format!("{text} [default: {default}]"))
}

/// The orders of rows that can be chosen; symmetric and colored sweeps are separate solvers.
const ORDERS: [(RowOrder, &str, &str); 3] = [
    (RowOrder::Natural, "natural", "First row first"),
    (RowOrder::Reverse, "reverse", "Last row first"),
    (
        RowOrder::Shuffled,
        "shuffled",
        "A random permutation, determined by --seed and the same in every sweep",
    ),
];

fn row_order() -> impl TypedValueParser<Value = RowOrder> {
    let words = ORDERS.map(|(_, name, help)| PossibleValue::new(name).help(help));
    let named = |word: String| ORDERS.into_iter().find(|(_, name, _)| *name == word);
    PossibleValuesParser::new(words)
        .try_map(move |word| named(word).map(|(order, ..)| order).ok_or("is no order"))
}

impl SolverArgs {
    /// The settings, with default values for those that are absent.
    pub fn new(
        tolerance: Option<f64>,
        max_iterations: Option<usize>,
        memory: MemoryLimit,
        choices: Choices,
    ) -> Self {
        let usual = Settings::default();
        SolverArgs {
            tolerance: tolerance.unwrap_or(usual.tolerance),
            max_iterations: max_iterations.unwrap_or(usual.max_iterations),
            memory,
            choices,
        }
    }

    /// The options for these solvers.
    pub fn options<'m>(&self, solvers: impl IntoIterator<Item = &'m Method>) -> Result<Options> {
        let settings = Settings::default()
            .with_tolerance(self.tolerance)
            .with_max_iterations(self.max_iterations)
            .with_memory(self.memory());
        let default = Options::default();
        let Choices { omega, order, seed, damping } = self.choices;
        let options = Options::default()
            .with_settings(settings)
            .with_omega(omega.unwrap_or(default.omega))
            .with_order(order.unwrap_or_default().seeded(seed.unwrap_or(1)))
            .with_damping(damping.map_or(default.damping, Damping::Factor));
        options.validate()?;
        let users: Vec<_> =
            solvers.into_iter().map(|method| (method.name(), method.uses())).collect();
        self.choices.check(&users, order)?;
        Ok(options)
    }

    pub fn memory(&self) -> Memory {
        self.memory.max_memory
    }

    pub fn demand(&self) -> Demand {
        Demand { tolerance: self.tolerance, ..Demand::default() }
    }
}

impl Choices {
    /// Checks that each given option is used by some solver; `order` is the effective order.
    pub fn check(
        &self,
        solvers: &[(&str, &'static [Choice])],
        order: Option<RowOrder>,
    ) -> Result<()> {
        if self.seed.is_some() && order != Some(RowOrder::Shuffled) {
            return Err(Error::invalid("options", "--seed", "needs --order shuffled"));
        }
        let mut defects = Defects::default();
        for (choice, given) in [
            (Choice::Omega, self.omega.is_some()),
            (Choice::Order, self.order.is_some()),
            (Choice::Damping, self.damping.is_some()),
        ] {
            if !given {
                continue;
            }
            let uses_it = |(_, uses): &&(&str, &[Choice])| uses.contains(&choice);
            let names: Vec<&str> = solvers.iter().filter(uses_it).map(|(name, _)| *name).collect();
            if names.is_empty() {
                let reason = match solvers {
                    [(name, _)] => format!("{name} does not use it; {}", having(choice)),
                    _ => format!("none of these solvers uses it; {}", having(choice)),
                };
                defects.add(format!("--{}", choice.name()), reason);
            } else if names.len() < solvers.len() {
                let (choice, names) = (choice.name(), names.join(", "));
                say(&format!("note: --{choice} applies only to {names}"));
            }
        }
        defects.into_result("options")
    }
}

/// The friction models, for the help of an option.
pub fn model_names() -> String {
    let name = |model: &Model| match model {
        Model::Polyhedral { directions: 4 } => Some(format!("{model} (or 8, 12, …)")),
        Model::Polyhedral { .. } => None,
        _ => Some(model.to_string()),
    };
    Model::ALL.iter().filter_map(name).collect::<Vec<_>>().join(", ")
}

/// The solvers that use an option, as text.
fn having(choice: Choice) -> String {
    let uses_it = |entry: &&Entry| entry.uses.contains(&choice);
    let entries = Registry::standard().entries().filter(uses_it);
    let names: Vec<&str> = entries.map(|entry| &*entry.name).collect();
    format!("{} {}", names.join(" and "), if names.len() == 1 { "does" } else { "do" })
}
