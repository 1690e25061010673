//! `--plugin`: another program as a solver.

use std::collections::BTreeMap;

use clap::{Arg, Args};
use lcplab::error::{Error, Result};
use lcplab::plugin::{Declaration, Plugin};
use lcplab::report::methods::with_reference;
use lcplab::solver::Registry;

use super::say;

/// Programs that solve problems.
#[derive(Debug, Args)]
pub struct Plugins {
    /// Run this command as a solver; the command reads problems and writes answers (see
    /// docs/plugins.md). The solver is named after its file; NAME=COMMAND sets another name
    #[arg(long, value_name = "COMMAND")]
    plugin: Vec<String>,
    /// Time limit for each answer of a plug-in
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    plugin_time_limit: f64,
}

impl Plugins {
    /// Starts the plug-ins; each ends when it is dropped. The registry has all solvers and them.
    pub fn start(&self) -> Result<(Vec<Plugin>, Registry)> {
        let limit = self.plugin_time_limit;
        registered(self.plugin.iter().map(|spec| Plugin::start(spec, limit)))
    }

    /// The commands, as they were given.
    pub fn commands(&self) -> impl Iterator<Item = &str> {
        self.plugin.iter().map(String::as_str)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.plugin.is_empty()
    }

    /// The solver of a command that uses only one: the named one, or the plug-in.
    pub fn sole<'a>(named: Option<&'a str>, plugins: &'a [Plugin]) -> Result<Option<&'a str>> {
        match (named, plugins) {
            (named, []) => Ok(named),
            (None, [plugin]) => Ok(Some(plugin.name())),
            _ => {
                let reason = "give either --solver or one --plugin";
                Err(Error::invalid("options", "--plugin", reason))
            }
        }
    }
}

/// The command in quotation marks, as a shell reads it.
pub fn quoted(command: &str) -> String {
    let is_plain = !command.contains(['"', '$', '`', '\\']);
    if is_plain {
        format!("\"{command}\"")
    } else {
        format!("'{}'", command.replace('\'', r"'\''"))
    }
}

/// The option `--plugin` of a command that runs several solvers.
pub fn repeatable(option: Arg) -> Arg {
    let help = option.get_help().map(ToString::to_string).unwrap_or_default();
    option.help(format!("{help} (repeatable)"))
}

/// These plug-ins, and a registry of all solvers and them.
fn registered(
    plugins: impl IntoIterator<Item = Result<Plugin>>,
) -> Result<(Vec<Plugin>, Registry)> {
    let (mut started, mut solvers) = (Vec::new(), with_reference().clone());
    for plugin in plugins {
        let plugin = plugin?;
        plugin.add_to(&mut solvers)?;
        started.push(plugin);
    }
    Ok((started, solvers))
}

/// Programs that a file declares.
#[derive(Debug, Args)]
pub struct Declared {
    /// Run the commands that the file lists under [plugins]; they are printed first
    #[arg(long)]
    allow_plugins: bool,
}

impl Declared {
    /// Starts the plug-ins of a file, if allowed; each ends when it is dropped. The registry has
    /// all solvers and them.
    pub fn start(
        &self,
        input: &str,
        plugins: &BTreeMap<String, Declaration>,
    ) -> Result<(Vec<Plugin>, Registry)> {
        if plugins.is_empty() {
            return registered([]);
        }
        let commands = plugins.iter().map(|(name, plugin)| format!("{name}: {}", plugin.command));
        let commands: Vec<String> = commands.collect();
        if !self.allow_plugins {
            let reason = format!(
                "lists commands to run: {}; add --allow-plugins to run them",
                commands.join(" and ")
            );
            return Err(Error::invalid(input, "plugins", reason));
        }
        commands.iter().for_each(|command| say(&format!("plug-in {command}")));
        registered(plugins.iter().map(|(name, plugin)| Plugin::declared(name, plugin)))
    }

    /// The option, if it was given.
    pub fn word(&self) -> Option<String> {
        self.allow_plugins.then(|| "--allow-plugins".into())
    }
}
