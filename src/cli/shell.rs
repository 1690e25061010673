//! `completions` and `man`: writes shell completions and manual pages.

use clap::{Args, Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;
use lcplab::error::{Error, Result};

use super::{Cli, Outcome, print};

/// Print the completions for a shell
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab completions bash > ~/.local/share/bash-completion/completions/lcplab")]
pub struct Completions {
    /// The shell
    shell: Shell,
}

/// Print the manual page, or that of a command
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab man > ~/.local/share/man/man1/lcplab.1
  lcplab man solve | man -l -")]
pub struct Manual {
    /// A command
    command: Option<String>,
}

impl Completions {
    pub fn run(&self) -> Result<Outcome> {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "lcplab", &mut text);
        print(&String::from_utf8_lossy(&text))?;
        Ok(Outcome::Good)
    }
}

impl Manual {
    pub fn run(&self) -> Result<Outcome> {
        let mut text = Vec::new();
        let page = Man::new(self.command()?).render(&mut text);
        page.map_err(|cause| Error::invalid("man", "page", cause.to_string()))?;
        print(&String::from_utf8_lossy(&text))?;
        Ok(Outcome::Good)
    }

    fn command(&self) -> Result<Command> {
        let mut whole = Cli::command();
        // This passes the global options to the commands.
        whole.build();
        let Some(name) = &self.command else { return Ok(whole) };
        whole.find_subcommand(name).cloned().ok_or_else(|| Error::Unknown {
            kind: "command",
            name: name.clone(),
            known: whole.get_subcommands().map(|command| command.get_name().into()).collect(),
        })
    }
}
