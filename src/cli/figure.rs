//! `fastphong figure`: figures of the lectures, made anew, as one page.

use super::files::{self, Destination};
use super::measured::command_line;
use super::output::Output;
use super::progress::Progress;
use super::{CliError, Log, Outcome, done};
use fastphong::lectures::{FIGURES, Figure};
use fastphong::report::{Document, FigureData, Report};
use rayon::prelude::*;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Redraw the lectures' figures, with measured values beside them, as one page
#[derive(clap::Args, Debug)]
pub struct FigureArgs {
    /// Figures, as `fastphong list figures` names them
    #[arg(value_name = "NAME", required_unless_present = "all", value_parser = Figure::find)]
    names: Vec<&'static Figure>,
    /// All figures
    #[arg(long, conflicts_with = "names")]
    all: bool,
    /// Page to write; its folder is made if there is none [default: report/figures/NAME.html, or index.html there for
    /// several]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Also write the pictures as PNG files into this folder
    #[arg(long, value_name = "FOLDER")]
    pictures: Option<PathBuf>,
}

impl FigureArgs {
    /// Draws, measures, and writes the page.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let figures = match self.all {
            true => FIGURES.to_vec(),
            false => distinct(self.names.clone()),
        };
        let page = match (&self.output, &figures[..]) {
            (Some(file), _) => file.clone(),
            (None, [one]) => format!("report/figures/{}.html", one.name).into(),
            (None, _) => "report/figures/index.html".into(),
        };
        page_folder(&page)?;
        if let Some(folder) = &self.pictures {
            make_folder(folder)?;
        }
        let progress = Progress::watched(log);
        let mut document = Document::new(command_line(), Vec::new());
        document.figures = draw_figures(&figures, &|part, name| progress.at(part, name))?;
        drop(progress);
        let report = Report::new(&document, Vec::new())?;
        let to = Output::destination(&page);
        files::write(to, |out| out.write_all(report.html().as_bytes()))?;
        let mut written = format!("{}\n", page.display());
        if let Some(folder) = &self.pictures {
            for (name, png) in report.figure_files() {
                let path = folder.join(name);
                let to = Destination {
                    name: "--pictures",
                    path: &path,
                };
                files::write(to, |out| out.write_all(png))?;
                written += &format!("{}\n", path.display());
            }
        }
        done(&written)
    }
}

/// Figures of the lectures.
pub type Figures = Vec<&'static Figure>;

/// Returns each of `figures` once.
pub fn distinct(mut figures: Figures) -> Figures {
    let mut names = HashSet::new();
    figures.retain(|figure| names.insert(figure.name));
    figures
}

/// Draws `figures` on all threads of the current pool; `progress` hears which part is done and which was drawn.
///
/// # Errors
/// When a figure cannot be drawn.
pub fn draw_figures(
    figures: &[&'static Figure],
    progress: &(dyn Fn(f32, &str) + Sync),
) -> Result<Vec<FigureData>, CliError> {
    let done = AtomicUsize::new(0);
    let draw = |figure: &&'static Figure| {
        let failed = |error| format!("figure {}: {error}", figure.name);
        let content = figure.make().map_err(failed)?;
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        let part = done as f32 / figures.len() as f32;
        progress(part, &format!("figure {}", figure.name));
        Ok(FigureData { figure, content })
    };
    figures.par_iter().map(draw).collect()
}

/// Returns the folder of a page, made if need be.
pub fn page_folder(page: &Path) -> Result<PathBuf, CliError> {
    let folder = page.parent().unwrap_or(Path::new("")).to_owned();
    let refused = |reason: &str| format!("{}: cannot be written: {reason}", page.display());
    if page.file_name().is_none() || page.is_dir() {
        let reason = "it is a folder: expected a file, such as report/index.html";
        return Err(refused(reason).into());
    }
    std::fs::create_dir_all(&folder).map_err(|error| refused(&error.to_string()))?;
    Ok(folder)
}

/// Makes a folder, if there is none.
pub fn make_folder(folder: &Path) -> Result<(), CliError> {
    let refused = |error| format!("{}: cannot be made: {error}", folder.display());
    Ok(std::fs::create_dir_all(folder).map_err(refused)?)
}
