//! `fastphong report`: every method on every scene, as one page.

use super::engines::{LectureFlags, ThreadFlags};
use super::figure::{add, drawn, page_folder};
use super::measured::{TimingFlags, command_line, named_or_shipped, warn_of_debug_build};
use super::progress::Progress;
use super::scene_flags::SceneFlags;
use super::studies::{Chosen, studies};
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::compare::comparison::{self, Comparison, Input, Triangulation, triangulation};
use fastphong::compare::timing::{Limits, Machine};
use fastphong::frame::Frame;
use fastphong::lectures::{FIGURES, Figure};
use fastphong::picture::image_file::write_file;
use fastphong::report::{Document, Report as Page, SceneData, ScenePictures, utc_date};
use fastphong::scene::Scene;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, Table};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Instant, SystemTime};

/// Compare methods on scenes, and show pictures, errors and times on one page
#[derive(clap::Args, Debug)]
pub struct Report {
    /// Scene files, mesh files, builtin:NAME?key=value, or names of shipped scenes [default: all shipped scenes]
    #[arg(value_name = "INPUT")]
    inputs: Vec<String>,
    #[command(flatten)]
    timing: TimingFlags,
    #[command(flatten)]
    drawn: LectureFlags,
    /// Where the page goes; its folder is made if there is none
    #[arg(short, long, value_name = "FILE", default_value = "report/index.html")]
    output: PathBuf,
    /// Figures of the lectures between commas, `all` or `none` [default: all with the shipped scenes, none with INPUT]
    #[arg(long, value_name = "NAMES", value_parser = figures)]
    figures: Option<Figures>,
    /// Studies between commas, `speedups` (what fast Phong gained and what is left of it) and `scaling` (how cost grows with
    /// triangles and pixels), `all` or `none` [default: all with the shipped scenes, none with INPUT]
    #[arg(long, value_name = "NAMES", value_parser = studies)]
    studies: Option<Chosen>,
    /// Draw every scene at its own size instead of 480x360 at most, and time every one for --time-budget instead of the
    /// first three, the others for a tenth of it
    #[arg(long)]
    full: bool,
    /// Lay files of `--json` side by side, of several machines or commits, without drawing
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["inputs", "figures", "studies", "full"])]
    from: Vec<PathBuf>,
    /// Write README.md and its pictures beside the page as well
    #[arg(long)]
    markdown: bool,
    /// Write all numbers as JSON as well
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write all tables as CSV as well
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    scene: SceneFlags,
}

/// The largest picture on the page, unless flags say otherwise.
const SHOWN: [i64; 2] = [480, 360];

/// Scenes that are timed for the whole of `--time-budget`.
const TIMED_LONG: usize = 3;

/// The figures of the lectures to show.
#[derive(Clone, Debug)]
struct Figures(Vec<&'static Figure>);

/// Figures between commas, each once, `all` or `none`.
fn figures(text: &str) -> Result<Figures, String> {
    match text {
        "all" => return Ok(Figures(FIGURES.to_vec())),
        "none" => return Ok(Figures(Vec::new())),
        _ => {}
    }
    let mut figures: Vec<&'static Figure> = Vec::new();
    for name in text.split(',') {
        let figure = Figure::find(name.trim())?;
        if figures.iter().all(|other| other.name != figure.name) {
            figures.push(figure);
        }
    }
    Ok(Figures(figures))
}

/// The folder of the small pictures, beside the text that shows them.
const IMAGES: &str = "images";

/// A scene that was drawn, not yet timed.
struct Drawn {
    frame: Frame,
    comparison: Comparison,
    triangles: Option<Triangulation>,
    pictures: ScenePictures,
}

impl Report {
    /// Compares, times, and writes the page.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        // What flags contradict, or files do not hold, is said before a folder is made.
        self.drawn.renderer()?;
        let read = match &self.from[..] {
            [] => None,
            files => Some(read(files)?),
        };
        let folder = page_folder(&self.output)?;
        let page = match read {
            Some(page) => page,
            None => self.make(*talk)?,
        };
        to_stdout(self.write(&page, &folder)?.as_bytes())?;
        Ok(Outcome::Done)
    }

    fn make(&self, talk: Talk) -> Result<Page, Failure> {
        let start = Instant::now();
        let names = named_or_shipped(&self.inputs);
        // What can fail at once does so before the first minute is spent.
        let load = |name: &&str| self.scene.load_to_show(name).map(|file| self.shown(file));
        let files = names
            .iter()
            .map(load)
            .collect::<Result<Vec<_>, Failure>>()?;
        let (figures, studies) = (self.figures(), self.studies());
        warn_of_debug_build(talk);
        let progress = Progress::silent_between_moves(talk);
        // Parts of the whole, as they were measured with the shipped scenes.
        let drawing = 0.4 * files.len() as f32 + 0.2 * figures.len() as f32;
        let timing = 0.5 * files.len() as f32;
        let all = drawing + studies.scenes() + timing;
        let mut page = Page::new(Document::new(Machine::this(), command_line()));
        let (scenes, made) = ThreadFlags {
            threads: self.drawn.threads.threads,
        }
        .install(|| {
            let done = AtomicUsize::new(0);
            let mut scenes: Vec<_> = files.iter().map(|_| None).collect();
            rayon::scope(|scope| {
                for ((name, file), drawn) in names.iter().zip(&files).zip(&mut scenes) {
                    let (done, progress) = (&done, &progress);
                    scope.spawn(move |_| {
                        *drawn = Some(self.draw(name, file, progress, talk));
                        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                        progress.at(0.4 * done as f32 / all, &format!("{name}: drawn"));
                    });
                }
            });
            let scenes: Result<Vec<Drawn>, Failure> = scenes.into_iter().flatten().collect();
            let told = |part: f32, what: &str| {
                let figures = 0.2 * figures.len() as f32;
                progress.at((drawing - figures * (1.0 - part)) / all, what);
            };
            Ok::<_, Failure>((scenes?, drawn(&figures, &told)?))
        })??;
        add(&mut page, made)?;
        let told =
            |part: f32, what: &str| progress.at((drawing + part * studies.scenes()) / all, what);
        (page.data.speedups, page.data.scaling) = studies.make(&self.timing, &told)?;
        for (number, scene) in scenes.into_iter().enumerate() {
            let told = |part: f32| {
                let done = all - timing + 0.5 * (number as f32 + part);
                progress.at(done / all, &format!("{}: timing", names[number]));
            };
            let file = &files[number];
            let (data, pictures) = self.timed(number, file, scene, &told)?;
            page.add_scene(data, pictures);
        }
        page.data.describe_methods();
        let since_1970 = SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .ok();
        page.data.date = since_1970.map(|t| utc_date(t.as_secs()));
        page.data.seconds = Some(start.elapsed().as_secs_f64());
        Ok(page)
    }

    /// Makes the picture of a scene no larger than the page shows it, unless flags say otherwise.
    fn shown(&self, mut file: SceneFile) -> SceneFile {
        if self.full || self.scene.gives(Some("image"), "width") {
            return file;
        }
        let image = file.table().table("image");
        let side = |key: &str, usual: u32| {
            let given = image.and_then(|image| image.get(key));
            match given.map(|value| &value.data) {
                Some(Data::Whole(side)) => *side,
                _ => i64::from(usual),
            }
        };
        let (width, height) = Scene::DEFAULT_SIZE;
        let size = [side("width", width), side("height", height)];
        let part = (0..2).map(|i| SHOWN[i] as f64 / size[i].max(1) as f64);
        let part = part.fold(1.0, f64::min);
        if part < 1.0 {
            let mut over = Table::default();
            let image = over.table_mut("image");
            for (key, side) in ["width", "height"].into_iter().zip(size) {
                let side = ((side as f64 * part).round() as i64).max(1);
                image.set(
                    key,
                    Data::Whole(side),
                    Origin::Flag("--resolution".to_owned()),
                );
            }
            file.overlay(over);
        }
        file
    }

    /// The figures that were asked for.
    fn figures(&self) -> Vec<&'static Figure> {
        match &self.figures {
            Some(figures) => figures.0.clone(),
            None if self.inputs.is_empty() => FIGURES.to_vec(),
            None => Vec::new(),
        }
    }

    /// The studies that were asked for.
    fn studies(&self) -> Chosen {
        let usual = if self.inputs.is_empty() {
            Chosen::ALL
        } else {
            Chosen::default()
        };
        self.studies.unwrap_or(usual)
    }

    /// Draws a scene with every method, and packs the pictures.
    fn draw(
        &self,
        name: &str,
        file: &SceneFile,
        progress: &Progress,
        talk: Talk,
    ) -> Result<Drawn, Failure> {
        let resolved = self.scene.resolve_to_show(&mut file.clone())?;
        progress.aside(|| self.scene.warn(&resolved, talk));
        let frame = resolved.scene.frame()?;
        drop(resolved);
        let input = Input {
            name: name.to_owned(),
            frame: &frame,
        };
        let (methods, renderer) = (&self.timing.methods.0, self.drawn.renderer()?);
        let mut comparison = comparison::draw(&input, methods, renderer, &mut |_, _| {});
        let triangles = triangulation(&frame, &comparison.reference);
        let pictures =
            ScenePictures::new(&comparison).map_err(|error| format!("{name}: {error}"))?;
        comparison.drop_pictures();
        Ok(Drawn {
            frame,
            comparison,
            triangles,
            pictures,
        })
    }

    /// Times a scene that was drawn.
    fn timed(
        &self,
        number: usize,
        file: &SceneFile,
        drawn: Drawn,
        told: &(dyn Fn(f32) + Sync),
    ) -> Result<(SceneData, ScenePictures), Failure> {
        let Drawn {
            frame,
            mut comparison,
            triangles,
            pictures,
        } = drawn;
        let long = self.full || number < TIMED_LONG;
        let limits = Limits {
            time_budget: self.timing.time_budget / if long { 1 } else { 10 },
            warm_up_rounds: 1,
            ..Limits::default()
        };
        let comparison = self.drawn.install(move || {
            comparison.time(&frame, limits, told);
            comparison
        })?;
        let title = file.title().unwrap_or_default().to_owned();
        let description = file.description().unwrap_or_default().to_owned();
        let data = SceneData::new(title, description, &comparison, triangles.as_ref());
        Ok((data, pictures))
    }

    /// Writes the page, and what goes beside it; the paths, a line each.
    fn write(&self, page: &Page, folder: &Path) -> Result<String, Failure> {
        write_file(&self.output, page.html().as_bytes())?;
        let mut written = format!("{}\n", self.output.display());
        if let Some(path) = &self.json {
            write_file(path, page.data.to_text().as_bytes())?;
            written += &format!("{}\n", path.display());
        }
        if let Some(path) = &self.csv {
            write_file(path, page.csv().as_bytes())?;
            written += &format!("{}\n", path.display());
        }
        if self.markdown {
            let markdown = page.markdown(IMAGES);
            let images = folder.join(IMAGES);
            std::fs::create_dir_all(&images)
                .map_err(|error| format!("{}: cannot be made: {error}", images.display()))?;
            for (name, png) in &markdown.images {
                write_file(&images.join(name), png)?;
            }
            let readme = folder.join("README.md");
            write_file(&readme, markdown.text.as_bytes())?;
            written += &format!("{}\n", readme.display());
        }
        Ok(written)
    }
}

/// Reads documents of `--json`: the first one is shown, the others stand beside it.
fn read(files: &[PathBuf]) -> Result<Page, Failure> {
    let document = |path: &PathBuf| {
        let text = std::fs::read_to_string(path)
            .map_err(|error| format!("{}: cannot be read: {error}", path.display()))?;
        let mut data: Document =
            comparison::parse(&text).map_err(|error| format!("{}: {error}", path.display()))?;
        if data.methods.is_empty() {
            data.describe_methods();
        }
        Ok::<_, Failure>(data)
    };
    let mut documents = files.iter().map(document).collect::<Result<Vec<_>, _>>()?;
    let beside = documents.split_off(1);
    let mut page = Page::new(documents.remove(0));
    page.beside = beside;
    Ok(page)
}
