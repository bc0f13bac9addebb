//! `fastphong report`: compares methods on every scene, as one page.

use super::contents::Contents;
use super::engines::LectureFlags;
use super::experiments::{Experiments, experiments};
use super::figure::{Figures, distinct, draw_figures};
use super::files;
use super::input_name;
use super::measured::{TimingFlags, command_line, named_or_shipped, warn_of_debug_build};
use super::output::{self, ForceFlag, Output, print_beside};
use super::progress::Progress;
use super::scene_flags::{SceneFlags, frame_of, note_scene};
use super::{CliError, Log, Outcome, memory};
use crate::compare::comparison::{self, Comparison, Input};
use crate::compare::timing::TimeLimits;
use crate::lectures::{FIGURES, Figure};
use crate::report::{
    Document, MOST_BYTES, MOST_POLYGONS, PartOf, Report, ScenePictures, Shard, check_whole,
    live_scene, small, utc_date,
};
use fastphong::frame::Frame;
use fastphong::picture::image_file::Format;
use fastphong::scene::Scene;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::open::Look;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Instant, SystemTime};

/// Compare methods on scenes, with pictures, errors and times on one page
#[derive(clap::Args, Debug)]
pub struct ReportArgs {
    /// Scene files, mesh files, builtin:NAME?key=value, names of shipped scenes, or `-` for
    /// standard input [default: all shipped scenes]
    #[arg(value_name = "INPUT", value_parser = input_name::parser())]
    inputs: Vec<String>,
    #[command(flatten)]
    timing: TimingFlags,
    #[command(flatten)]
    drawn: LectureFlags,
    /// Page to write, `-` for standard output; its folder is made if needed [default:
    /// report/index.html]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Figures of the lectures, separated by commas, `all` (which adds the course) or `none`
    /// [default: all with the shipped scenes, none with INPUT]
    #[arg(long, value_name = "NAMES", value_parser = figures)]
    figures: Option<Figures>,
    /// Experiments, separated by commas: `speedups` (kernels and frames, scalar and SIMD),
    /// `scaling` (cost over triangles and pixels), `all` or `none` [default: all with the shipped
    /// scenes, none with INPUT]
    #[arg(long, value_name = "NAMES", value_parser = experiments)]
    studies: Option<Experiments>,
    /// Draw every scene at its own size instead of at most 480x360, and time every scene for the
    /// whole --time-budget instead of only the first two
    #[arg(long)]
    full: bool,
    /// Compare saved `--json` files of several machines or commits side by side, without drawing.
    /// The files of all parts of one run (`--shard`) are joined. `-` is standard input
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = SceneFlags::and(&["inputs", "figures", "studies", "full", "shard", "methods", "time_budget", "engine", "simd", "threads"]))]
    from: Vec<PathBuf>,
    /// Do part K of N of the scenes, with errors but without times; `--from` joins the `--json`
    /// files of all parts
    #[arg(long, value_name = "K/N", value_parser = Shard::parse, conflicts_with_all = ["figures", "studies", "time_budget"])]
    shard: Option<Shard>,
    /// Also write README.md and its pictures beside the page
    #[arg(long)]
    markdown: bool,
    /// Also write all results as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Also write all tables as CSV; `-` is standard output
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    force: ForceFlag,
    #[command(flatten)]
    scene: SceneFlags,
}

/// The largest picture on the page, in pixels, unless flags set another size.
const SHOWN: [i64; 2] = [480, 360];

/// The share of a scene's time for drawing its pictures. The rest is for packing them.
const PICTURES_PART: f32 = 0.9;

/// How many scenes are timed for the whole `--time-budget`.
const TIMED_LONG: usize = 2;

/// Reads figures separated by commas, without duplicates, or `all` or `none`.
fn figures(text: &str) -> Result<Figures, String> {
    match text {
        "all" => Ok(FIGURES.to_vec()),
        "none" => Ok(Vec::new()),
        names => {
            let figures = names.split(',').map(|name| Figure::find(name.trim()));
            figures.collect::<Result<_, _>>().map(distinct)
        }
    }
}

/// The folder for the small pictures, beside the Markdown file that shows them.
const IMAGES: &str = "images";

/// The default of `--output`.
const PAGE: &str = "report/index.html";

/// The files of a report, without the pictures of the Markdown file.
struct Outputs {
    page: Output,
    json: Option<Output>,
    csv: Option<Output>,
    readme: Option<Output>,
}

impl Outputs {
    fn all(&self) -> Vec<&Output> {
        let others = [&self.json, &self.csv, &self.readme];
        let others = others.into_iter().flatten();
        std::iter::once(&self.page).chain(others).collect()
    }
}

/// A scene that was drawn but not yet timed.
type DrawnScene = (Frame, Comparison, ScenePictures);

impl ReportArgs {
    /// Compares and times the methods, and writes the page.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        // Refuse contradicting flags and bad documents before making a folder.
        self.drawn.renderer()?;
        let read = self.from.iter().map(|path| read(path, log));
        let read = read.collect::<Result<Vec<Report>, _>>()?;
        let mut read = self.joined(read)?.into_iter();
        let first = read.next();
        let names = self.names()?;
        // Every input is loaded first, so that a bad one fails at once.
        let load = |name: &&str| self.scene.read(name).map(|file| self.shown(file));
        let inputs: &[&str] = if first.is_some() { &[] } else { &names };
        let scenes = inputs.iter().map(load).collect::<Result<Vec<_>, _>>()?;
        let outputs = self.outputs()?;
        if first.is_some() {
            output::check(&outputs.all())?
        } else {
            output::check_places(&outputs.all())?
        }
        outputs.page.make_folder()?;
        let mut report = match first {
            Some(report) => report,
            None => self.make(&names, &scenes, &outputs, log)?,
        };
        read.for_each(|other| report.lay_beside(other));
        self.write(&report, &outputs)?;
        Ok(Outcome::Done)
    }

    /// Returns the outputs that are known before anything is drawn.
    fn outputs(&self) -> Result<Outputs, CliError> {
        let named = |name, path: &Option<PathBuf>, contents| {
            path.as_deref()
                .map(|path| Output::new(name, path, contents))
        };
        let page = Output::page(self.output.as_deref(), || PAGE.to_owned(), self.force);
        let readme = match (self.markdown, page.path()) {
            (false, _) => None,
            (true, Some(page)) => {
                let path = page.with_file_name("README.md");
                let contents = Contents::Markdown;
                Some(Output::chosen("--markdown", path, contents, self.force))
            }
            (true, None) => {
                let problem = "`--markdown` writes beside the page, which goes to standard output";
                return Err(format!("{problem}: expected `-o FILE`").into());
            }
        };
        Ok(Outputs {
            page,
            json: named("--json", &self.json, Contents::Json),
            csv: named("--csv", &self.csv, Contents::Csv),
            readme,
        })
    }

    /// Returns the names of the scenes of this part.
    fn names(&self) -> Result<Vec<&str>, CliError> {
        let all = named_or_shipped(&self.inputs);
        let shard = self.shard.unwrap_or(Shard::WHOLE);
        if shard.of as usize > all.len() {
            let (of, scenes) = (shard.of, all.len());
            return Err(format!(
                "`--shard {}/{of}`: there are fewer scenes than parts: expected at most {scenes}",
                shard.number
            )
            .into());
        }
        let named = all.into_iter().enumerate();
        Ok(named
            .filter(|(index, _)| shard.has(*index))
            .map(|(_, name)| name)
            .collect())
    }

    /// Joins documents that are parts of one run and keeps the others unchanged. The result is in
    /// the order of their first files.
    fn joined(&self, read: Vec<Report>) -> Result<Vec<Report>, CliError> {
        let mut groups: Vec<(Vec<Report>, Vec<PartOf>)> = Vec::new();
        for (report, path) in read.into_iter().zip(&self.from) {
            let Some((run, shard)) = report.part() else {
                groups.push((vec![report], Vec::new()));
                continue;
            };
            let (run, file) = (run.to_owned(), path.display().to_string());
            if !shard.is_part() {
                let Shard { number, of } = shard;
                return Err(format!("{file}: it says it is part {number} of {of}").into());
            }
            let part = PartOf { file, run, shard };
            let is_of_run = |(_, parts): &&mut (_, Vec<PartOf>)| {
                let first = parts.first().map(|first| (&first.run, first.shard.of));
                first == Some((&part.run, shard.of))
            };
            match groups.iter_mut().find(is_of_run) {
                Some((reports, parts)) => {
                    reports.push(report);
                    parts.push(part);
                }
                None => groups.push((vec![report], vec![part])),
            }
        }
        let join = |(mut reports, parts): (Vec<Report>, Vec<PartOf>)| {
            check_whole(&parts)?;
            Ok(if parts.is_empty() {
                reports.swap_remove(0)
            } else {
                Report::joined(reports)
            })
        };
        groups.into_iter().map(join).collect()
    }

    /// Draws, measures and times the scenes `files`. `names` are their names.
    fn make(
        &self,
        names: &[&str],
        files: &[SceneFile],
        outputs: &Outputs,
        log: Log,
    ) -> Result<Report, CliError> {
        let start = Instant::now();
        // The default report, of the shipped scenes, has all figures and experiments.
        let is_default = self.inputs.is_empty() && self.shard.is_none();
        let default = if is_default { "all" } else { "none" };
        let figures = self.figures.clone().map_or_else(|| figures(default), Ok)?;
        let experiments = self.studies.map_or_else(|| experiments(default), Ok)?;
        warn_of_debug_build(log);
        let bar = Progress::silent_between_moves(log);
        // The relative durations of the four stages (drawing, figures, experiments, timing),
        // measured with the shipped scenes.
        let scenes = files.len() as f32;
        let parts = [
            0.4 * scenes,
            0.2 * figures.len() as f32,
            experiments.scenes(),
            0.5 * scenes,
        ];
        let all: f32 = parts.iter().sum();
        let progress = |stage: usize, part: f32, next: &str| {
            let before: f32 = parts[..stage].iter().sum();
            bar.at((before + part * parts[stage]) / all, next);
        };
        // Progress of drawing, summed over all scenes, in thousandths of a scene.
        let done = AtomicUsize::new(0);
        let draw = |(name, file): (&&str, &SceneFile)| {
            let mut own = 0;
            let mut add = |part: f32, next: &str| {
                let step = ((1e3 * part) as usize).saturating_sub(own);
                let all = done.fetch_add(step, Ordering::Relaxed) + step;
                own += step;
                progress(0, all as f32 / 1e3 / scenes, &format!("{name}: {next}"));
            };
            add(0.0, "loading");
            let drawn = self.draw(name, file, outputs, &bar, log, &mut add);
            add(1.0, "drawn");
            drawn
        };
        let mut document = Document::new(command_line(), Vec::new());
        let (drawn, figures) = self.drawn.threads.install(|| {
            // Wait for all scenes before returning the first error, so that every run reports the
            // same one.
            let drawn: Vec<_> = names.par_iter().zip(files).map(draw).collect();
            let drawn = drawn.into_iter().collect::<Result<Vec<DrawnScene>, _>>()?;
            let figures = draw_figures(&figures, &|part, name| progress(1, part, name))?;
            Ok::<_, CliError>((drawn, figures))
        })??;
        document.figures = figures;
        document.small = Some(small());
        (document.speedups, document.scaling) =
            experiments.make(&self.timing, &|part, next| progress(2, part, next))?;
        let mut pictures = Vec::new();
        for (index, (frame, mut comparison, shown)) in drawn.into_iter().enumerate() {
            let next = format!("{}: timing", names[index]);
            let progress = |part| progress(3, (index as f32 + part) / scenes, &next);
            if self.shard.is_none() {
                self.time(index, &frame, &mut comparison, &progress)?;
            }
            pictures.push(shown);
            document.comparisons.push(comparison);
        }
        document.describe_methods();
        if let Some(shard) = self.shard {
            document.run = Some(run(command_line()));
            document.shard = Some(shard);
        }
        let since_1970 = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
        document.date = since_1970.ok().map(|time| utc_date(time.as_secs()));
        document.seconds = Some(start.elapsed().as_secs_f64());
        Ok(Report::new(&document, pictures)?)
    }

    /// Shrinks the picture of a scene to the size on the page, unless flags set the size.
    fn shown(&self, mut file: SceneFile) -> SceneFile {
        if self.full || self.scene.over().sets("image.width") {
            return file;
        }
        let image = file.table().table("image");
        let side = |key, default: u32| match image.and_then(|image| Some(&image.get(key)?.data)) {
            Some(Data::Whole(side)) => *side,
            _ => i64::from(default),
        };
        let (width, height) = Scene::DEFAULT_SIZE;
        let size = [side("width", width), side("height", height)];
        let part = (0..2).map(|i| SHOWN[i] as f64 / size[i].max(1) as f64);
        let part = part.fold(1.0, f64::min);
        if part < 1.0 {
            let mut over = SceneTable::default();
            let image = over.table_mut("image");
            for (key, side) in ["width", "height"].into_iter().zip(size) {
                let side = ((side as f64 * part).round() as i64).max(1);
                let origin = Origin::Flag("--resolution".to_owned());
                image.set(key, Data::Whole(side), origin);
            }
            file.overlay(over);
        }
        file
    }

    /// Draws a scene with every method, and packs the pictures.
    fn draw(
        &self,
        name: &str,
        file: &SceneFile,
        outputs: &Outputs,
        bar: &Progress,
        log: Log,
        progress: &mut dyn FnMut(f32, &str),
    ) -> Result<DrawnScene, CliError> {
        let opened = self.scene.open_file(file.clone(), Look::Shown)?;
        // Only now are the material libraries of the meshes known.
        output::check(&outputs.all())?;
        bar.aside(|| note_scene(&opened, log));
        let frame = bar.aside(|| frame_of(&opened, log))?;
        let file = opened.file;
        drop(opened.scene);
        let at_once = rayon::current_num_threads().min(self.names()?.len());
        bar.aside(|| memory::check(&frame, &self.timing.methods, at_once, log))?;
        let input = Input {
            name: name.to_owned(),
            frame: &frame,
        };
        let (methods, renderer) = (&self.timing.methods, self.drawn.renderer()?);
        let mut comparison = comparison::draw(&input, methods, renderer, &mut |part, next| {
            progress(PICTURES_PART * part, next);
        });
        comparison.title = file.title().unwrap_or_default().to_owned();
        comparison.description = file.description().unwrap_or_default().to_owned();
        progress(PICTURES_PART, "packing pictures");
        let pictures = ScenePictures::new(&comparison);
        let pictures = pictures.map_err(|error| format!("{name}: {error}"))?;
        let is_small = frame.polygons().len() <= MOST_POLYGONS;
        let files = is_small
            .then(|| files::of_scene(&file, MOST_BYTES))
            .flatten();
        let pictures =
            pictures.with_live(files.and_then(|files| live_scene(&file.to_toml(), &files)));
        comparison.drop_pictures();
        Ok((frame, comparison, pictures))
    }

    /// Times the scene at `index`, which was drawn before.
    fn time(
        &self,
        index: usize,
        frame: &Frame,
        comparison: &mut Comparison,
        progress: &(dyn Fn(f32) + Sync),
    ) -> Result<(), CliError> {
        let is_long = self.full || index < TIMED_LONG;
        let limits = TimeLimits {
            time_budget: self.timing.time_budget / if is_long { 1 } else { 5 },
            warm_up_rounds: 1,
            ..TimeLimits::default()
        };
        let time = || comparison.time(frame, limits, progress);
        let renderer = self.drawn.renderer()?;
        self.drawn.threads.install_for(renderer, time)
    }

    /// Writes the page and the files beside it, and prints their paths, one per line.
    fn write(&self, report: &Report, outputs: &Outputs) -> Result<(), CliError> {
        let markdown = outputs.readme.as_ref().map(|_| report.markdown(IMAGES));
        let readme = outputs.readme.as_ref().and_then(Output::path);
        let images = readme.map_or(PathBuf::new(), |path| path.with_file_name(IMAGES));
        let pictures = markdown.iter().flat_map(|markdown| &markdown.images);
        let pictures: Vec<(Output, &[u8])> = pictures
            .map(|(name, png)| {
                let (path, contents) = (images.join(name), Contents::Picture(Format::Png));
                let output = Output::chosen("--markdown", path, contents, self.force);
                (output, &png[..])
            })
            .collect();
        let all = outputs.all();
        let pictures_too = pictures.iter().map(|(output, _)| output);
        output::check(&all.iter().copied().chain(pictures_too).collect::<Vec<_>>())?;
        outputs.page.write_text(&report.html())?;
        if let Some(json) = &outputs.json {
            json.write_text(&report.text)?;
        }
        if let Some(csv) = &outputs.csv {
            csv.write_text(&report.csv())?;
        }
        if let (Some(readme), Some(markdown)) = (&outputs.readme, &markdown) {
            output::make_folder(&images)?;
            for (output, png) in &pictures {
                output.write_bytes(png)?;
            }
            readme.write_text(&markdown.text)?;
        }
        print_beside(&all, &output::written(&all))
    }
}

/// Returns the text by which the parts of one run recognise each other: the version and the command
/// line, without the flags for the part, for output files, and for settings that change no error.
fn run(command_line: Vec<String>) -> String {
    const OWN: [&str; 7] = [
        "--shard",
        "--json",
        "--csv",
        "--output",
        "-o",
        "--threads",
        "--time-budget",
    ];
    const SWITCHES: [&str; 6] = ["--markdown", "--force", "-q", "--quiet", "-v", "--verbose"];
    let mut words = command_line.into_iter();
    let mut run = vec![env!("CARGO_PKG_VERSION").to_owned()];
    while let Some(word) = words.next() {
        let (flag, value) = match word.split_once('=') {
            Some((flag, value)) => (flag, Some(value)),
            None => (&*word, None),
        };
        match OWN.contains(&flag) {
            _ if SWITCHES.contains(&flag) => {}
            _ if word.starts_with("-o") && word != "-o" => {} // `-oPAGE`
            // The next word is the value of the flag, unless it came as `--shard=1/4`.
            true if value.is_none() => drop(words.next()),
            true => {}
            false => run.push(word),
        }
    }
    run.join(" ")
}

/// Reads a document of `--json`, and notes which of its values cannot be compared with a current
/// document.
fn read(path: &Path, log: Log) -> Result<Report, CliError> {
    let shown = path.display();
    let text =
        files::document(path).map_err(|error| format!("{shown}: cannot be read: {error}"))?;
    let report = Report::read(text).map_err(|error| format!("{shown}: {error}"))?;
    if let Some(limits) = report.not_comparable() {
        log.note(&format!("{shown}: {limits}"));
    }
    Ok(report)
}
