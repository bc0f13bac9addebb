//! `fastphong completions` and `fastphong man`: shell completions and manual pages, made from the
//! definitions of the flags.

use super::contents::Contents;
use super::engines::{ENGINES, EngineFlag, ScanlineEngine, Simd, SimdList};
use super::experiments::{self, Experiments};
use super::figure::Figures;
use super::log::to_stdout_by;
use super::measured::Methods;
use super::output::{self, ForceFlag, Output};
use super::{Cli, CliError, Outcome};
use crate::lectures::{FIGURES, Figure};
use clap::builder::{PossibleValue, TypedValueParser, ValueParser};
use clap::{Arg, Command, CommandFactory, ValueHint};
use clap_complete::Shell;
use clap_mangen::Man;
use fastphong::drawing::Drawing;
use fastphong::number::SimdLevel;
use fastphong::picture::Encoding;
use fastphong::picture::image_file::Format;
use fastphong::shading::{Family, METHODS, Variant};
use std::any::TypeId;
use std::ffi::OsStr;
use std::path::PathBuf;

/// Print a completion script for a shell, to be installed where the shell expects it
#[derive(clap::Args, Debug)]
pub struct CompletionsArgs {
    /// Shell to complete in
    shell: Shell,
}

impl CompletionsArgs {
    /// Prints the script.
    pub fn run(&self) -> Result<Outcome, CliError> {
        let mut script = Vec::new();
        let mut command = Cli::command();
        let names: Vec<String> = command
            .get_subcommands()
            .map(|sub| sub.get_name().into())
            .collect();
        for name in names {
            command = command.mut_subcommand(name, |sub| sub.mut_args(completed));
        }
        clap_complete::generate(self.shell, &mut command, "fastphong", &mut script);
        to_stdout_by(|out| out.write_all(&script))?;
        Ok(Outcome::Done)
    }
}

/// Adds what shells offer as values of a flag: names, files or nothing.
fn completed(arg: Arg) -> Arg {
    let count = arg.get_num_args();
    let is_switch = !arg.get_action().takes_values() || count.is_some_and(|n| n.max_values() == 0);
    if is_switch || !arg.get_possible_values().is_empty() {
        return arg;
    }
    let hint = arg.get_value_hint();
    let is_folder = arg
        .get_value_names()
        .is_some_and(|names| names == ["FOLDER"]);
    match words(arg.get_value_parser()) {
        Some(words) => arg.value_parser(Words(words)),
        None if is_folder => arg.value_hint(ValueHint::DirPath),
        // Completed by lines: names of files may contain spaces.
        None if hint == ValueHint::AnyPath => arg.value_hint(ValueHint::FilePath),
        None if arg.is_positional() => arg,
        None => arg.value_hint(ValueHint::Other),
    }
}

/// Returns the values that a parser reads, if they have names.
fn words(parser: &ValueParser) -> Option<Vec<&'static str>> {
    let methods: Vec<&str> = METHODS.iter().map(|method| method.info.name).collect();
    let families = Family::ALL.map(Family::name);
    let groups = ["default", "all", "floats", "integers", "exhibits"];
    let levels = SimdLevel::ALL.map(SimdLevel::name);
    let engines = ENGINES.map(|engine| engine.name);
    let figures: Vec<&str> = FIGURES.iter().map(|figure| figure.name).collect();
    let all = [
        (
            TypeId::of::<Drawing>(),
            [&[Drawing::AUTO, Drawing::REFERENCE], &methods[..]].concat(),
        ),
        (
            TypeId::of::<Methods>(),
            [&groups[..], &families[..], &methods].concat(),
        ),
        (TypeId::of::<Variant>(), methods),
        (
            TypeId::of::<EngineFlag>(),
            [&["auto"], &engines[..]].concat(),
        ),
        (TypeId::of::<ScanlineEngine>(), vec!["auto", "span", "row"]),
        (TypeId::of::<Simd>(), [&["auto"], &levels[..]].concat()),
        (
            TypeId::of::<SimdList>(),
            [&["auto", "all"], &levels[..]].concat(),
        ),
        (
            TypeId::of::<Figures>(),
            [&["all", "none"], &figures[..]].concat(),
        ),
        (TypeId::of::<&'static Figure>(), figures),
        (
            TypeId::of::<Experiments>(),
            [&["all", "none"], &experiments::NAMES[..]].concat(),
        ),
        (
            TypeId::of::<Format>(),
            Format::ALL.map(Format::ending).to_vec(),
        ),
        (
            TypeId::of::<Encoding>(),
            Encoding::ALL.map(Encoding::name).to_vec(),
        ),
    ];
    let of = parser.type_id();
    let found = all.into_iter().find(|(known, _)| of == *known);
    found.map(|(_, words)| words)
}

/// A parser that takes any text, and lists some: methods also have parameters, and lists commas.
#[derive(Clone)]
struct Words(Vec<&'static str>);

impl TypedValueParser for Words {
    type Value = String;

    fn parse_ref(&self, _: &Command, _: Option<&Arg>, text: &OsStr) -> Result<String, clap::Error> {
        Ok(text.to_string_lossy().into_owned())
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.0.iter().map(PossibleValue::new)))
    }
}

/// Print the manual page, or write the pages of all commands into a folder
#[derive(clap::Args, Debug)]
pub struct ManArgs {
    /// Folder for the pages fastphong.1, fastphong-render.1, …; it is made if needed
    folder: Option<PathBuf>,
    #[command(flatten)]
    force: ForceFlag,
}

impl ManArgs {
    /// Prints the page, or writes all pages.
    pub fn run(&self) -> Result<Outcome, CliError> {
        let Some(folder) = &self.folder else {
            to_stdout_by(|out| Man::new(Cli::command()).render(out))?;
            return Ok(Outcome::Done);
        };
        let folder = output::folder("FOLDER", folder)?;
        std::fs::create_dir_all(folder)
            .map_err(|error| format!("{}: cannot be written: {error}", folder.display()))?;
        let mut command = Cli::command().disable_help_subcommand(true);
        command.build();
        let mut pages = Vec::new();
        collect(&command, &mut pages);
        let pages = pages.into_iter().map(|page| {
            let path = folder.join(page.get_filename());
            let output = Output::chosen("FOLDER", path, Contents::Manual, self.force);
            (page, output)
        });
        let pages: Vec<(Man, Output)> = pages.collect();
        output::check(&pages.iter().map(|(_, output)| output).collect::<Vec<_>>())?;
        for (page, output) in &pages {
            output.write(|out| page.render(out))?;
        }
        Ok(Outcome::Done)
    }
}

/// Adds the pages of `command` and its sub-commands.
fn collect(command: &Command, pages: &mut Vec<Man>) {
    pages.push(Man::new(command.clone()));
    let shown = command.get_subcommands().filter(|sub| !sub.is_hide_set());
    shown.for_each(|sub| collect(sub, pages));
}
