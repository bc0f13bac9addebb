//! `fastphong figure`: redraws figures of the lectures, with measurements, as one page.

use super::contents::Contents;
use super::measured::command_line;
use super::output::{self, ForceFlag, Output, print_beside};
use super::progress::Progress;
use super::{CliError, Log, Outcome};
use crate::lectures::{FIGURES, Figure};
use crate::report::{Document, FigureData, Report};
use fastphong::picture::image_file::Format;
use rayon::prelude::*;
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Redraw the lectures' figures, with measured values beside them, as one page
#[derive(clap::Args, Debug)]
pub struct FigureArgs {
    /// Figures, as `fastphong list figures` names them
    #[arg(value_name = "NAME", value_parser = Figure::find)]
    names: Vec<&'static Figure>,
    /// All figures
    #[arg(long, conflicts_with = "names")]
    all: bool,
    /// Page to write, `-` for standard output; its folder is made if needed [default:
    /// report/figures/NAME.html, or report/figures/index.html for several figures]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Also write the pictures as PNG files into this folder
    #[arg(long, value_name = "FOLDER")]
    pictures: Option<PathBuf>,
    #[command(flatten)]
    force: ForceFlag,
}

impl FigureArgs {
    /// Draws and measures the figures, and writes the page.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let figures = if self.all {
            FIGURES.to_vec()
        } else {
            distinct(self.names.clone())
        };
        if figures.is_empty() {
            return Err(
                "which figure? `fastphong list figures` names them, and --all draws all".into(),
            );
        }
        let default = || match &figures[..] {
            [one] => format!("report/figures/{}.html", one.name),
            _ => "report/figures/index.html".to_owned(),
        };
        let page = Output::page(self.output.as_deref(), default, self.force);
        let folder = self.pictures.as_deref();
        let folder = folder.map(|folder| output::folder("--pictures", folder));
        let folder = folder.transpose()?;
        output::check(&[&page])?;
        page.make_folder()?;
        if let Some(folder) = folder {
            output::make_folder(folder)?;
        }
        let progress = Progress::watched(log);
        let mut document = Document::new(command_line(), Vec::new());
        document.figures = draw_figures(&figures, &|part, name| progress.at(part, name))?;
        drop(progress);
        let report = Report::new(&document, Vec::new())?;
        let contents = Contents::Picture(Format::Png);
        let pictures = folder.into_iter().flat_map(|folder| {
            let files = report.figure_files();
            files.map(|(name, png)| {
                let path = folder.join(name);
                let output = Output::chosen("--pictures", path, contents, self.force);
                (output, png)
            })
        });
        let pictures: Vec<_> = pictures.collect();
        let all = std::iter::once(&page).chain(pictures.iter().map(|(output, _)| output));
        let all: Vec<&Output> = all.collect();
        output::check(&all)?;
        page.write_text(&report.html())?;
        for (output, png) in &pictures {
            output.write_bytes(png)?;
        }
        print_beside(&all, &output::written(&all))?;
        Ok(Outcome::Done)
    }
}

/// Figures of the lectures.
pub type Figures = Vec<&'static Figure>;

/// Removes duplicates from `figures`.
pub fn distinct(mut figures: Figures) -> Figures {
    let mut names = HashSet::new();
    figures.retain(|figure| names.insert(figure.name));
    figures
}

/// Draws `figures` on all threads of the current pool. Calls `progress` with the part that is done
/// and the figure just drawn.
///
/// # Errors
/// If a figure cannot be drawn.
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
