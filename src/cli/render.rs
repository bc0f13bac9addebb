//! `fastphong render`: from an input to a picture.

use super::aov::Aov;
use super::auto::{AskedMethod, asked_method};
use super::drawing::{AUTO, Content, Drawing};
use super::engines::{self, Engine, Simd, ThreadFlags, renderer};
use super::name_template::{named, scene_name};
use super::output::{self, Output};
use super::progress::Progress;
use super::reference_check::ReferenceCheck;
use super::scene_flags::SceneFlags;
use super::table::columns;
use super::talk::{Talk, counted, grouped, to_stderr, to_stdout};
use super::watch::watch;
use super::{Failure, Outcome, values};
use fastphong::frame::{Frame, FrameStats};
use fastphong::picture::image_file::Format;
use fastphong::raster::Renderer;
use fastphong::raster::painter::{Conflicts, conflicts};
use fastphong::scene::{HiddenSurfaces, input};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Draw a scene or a mesh
#[derive(clap::Args, Debug)]
pub struct Render {
    /// A scene file, a mesh file, builtin:NAME?key=value, or the name of a shipped scene
    input: String,
    /// Destination of the picture: .png, .ppm or .pfm (linear floats); `-` is standard output. `{scene}`, `{method}`, `{engine}`,
    /// `{width}` and `{height}` stand for those of the picture
    #[arg(short, long, value_name = "FILE", required_unless_present_any = ["print_scene", "reference", "stats"])]
    output: Option<PathBuf>,
    /// Format of the picture, whatever the file is called [default: by its ending, png on standard output]
    #[arg(long, value_name = "png|ppm|pfm", value_parser = output::format, requires = "output")]
    format: Option<Format>,
    /// Shading method, with parameters as in `fast-phong:steps=1`; see `fastphong list methods`. `auto` is naive Phong's
    /// picture in the least time: `fastphong info` says by which method. `reference` is the closed form in f64,
    /// `reference:model=flat|gouraud|phong|slerp`
    #[arg(short, long, default_value = AUTO, value_parser = asked_method)]
    method: AskedMethod,
    /// Engine that finds the pixels: `span`, the lecture's way, one pixel at a time (also called `scanline`); `row`, SIMD; `auto`,
    /// `row` where it can draw the frame; `barycentric`, also with `:edges=top-left|closed`; or `cs171`, also with `:normals=unit|as-printed`. See `fastphong
    /// list engines`
    #[arg(long, default_value = "auto", value_parser = engines::engine)]
    engine: Engine,
    /// Instruction set of the pixel loops: `auto`, the best of this machine, or one of `fastphong list simd`: `scalar` is the
    /// span engine, any other the row engine. `--simd scalar` is the lecture's own form: one thread, the same bytes on every
    /// platform
    #[arg(long, value_name = "LEVEL", default_value = "auto", value_parser = engines::simd)]
    simd: Simd,
    #[command(flatten)]
    threads: ThreadFlags,
    /// Show something else than colours
    #[arg(long, value_enum, conflicts_with_all = ["method", "engine", "simd"])]
    aov: Option<Aov>,
    /// Side of a square of `--aov checkerboard`, in world units
    #[arg(long, value_name = "UNITS", default_value = "1", value_parser = values::length, allow_hyphen_values = true, requires = "aov")]
    square: f64,
    /// Print the scene, flags included, as a scene file
    #[arg(long)]
    print_scene: bool,
    /// Print what became of the polygons
    #[arg(long)]
    stats: bool,
    /// Compare the picture with this one: exit code 1 on a difference, with the actual picture and a map of the
    /// difference beside it
    #[arg(long, value_name = "FILE", visible_alias = "ref")]
    reference: Option<PathBuf>,
    /// Grey levels, of 255, that a channel may differ from the reference; a pixel that only one of the pictures covers
    /// differs by 255
    #[arg(long, value_name = "LEVELS", default_value = "1", value_parser = values::grey_levels, allow_hyphen_values = true, requires = "reference", visible_alias = "ref-threshold")]
    reference_threshold: f64,
    /// Draw again whenever a file of the scene changes, until Ctrl-C
    #[arg(long)]
    watch: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

impl Render {
    /// Draws, compares and prints, as asked for.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let talk = *talk;
        let draw = || self.threads.install(|| self.draw(talk))?;
        match self.watch {
            true => watch(&self.input, talk, draw),
            false => draw(),
        }
    }

    /// Loads, draws, writes and compares.
    fn draw(&self, talk: Talk) -> Result<Outcome, Failure> {
        let mut output = self.output()?;
        // A picture on standard output leaves no room there for words.
        let say: fn(&str) -> Result<(), Failure> = match &output {
            Some(Output { path: None, .. }) => |text| {
                to_stderr(text);
                Ok(())
            },
            _ => |text| to_stdout(text.as_bytes()),
        };
        let renderer = self.renderer()?;
        let shows = self.aov.is_none();
        let mut file = match shows {
            true => self.scene.load_to_show(&self.input)?,
            false => self.scene.load(&self.input)?,
        };
        let progress = Progress::watched(talk);
        progress.at(0.0, "loading");
        let started = Instant::now();
        let mut resolved = match shows {
            true => self.scene.resolve_to_show(&mut file)?,
            false => input::resolve(&file)?,
        };
        if self.aov.is_some() && std::mem::replace(&mut resolved.scene.samples, 1) > 1 {
            // Depths, normals and polygon numbers have no mean that means anything.
            progress.aside(|| talk.note("--aov shows single samples: one a pixel, in its middle"));
        }
        progress.aside(|| {
            self.scene.warn(&resolved, talk);
            talk.detail(&format!("loaded in {:.1} ms", milliseconds(started)));
        });
        if self.print_scene {
            input::make_paths_relative_to_current_folder(&mut file);
            progress.aside(|| say(&file.to_toml()))?;
        }
        if output.is_none() && self.reference.is_none() && !self.stats {
            return Ok(Outcome::Done);
        }
        progress.at(0.25, "projecting");
        let started = Instant::now();
        let frame = resolved.scene.frame()?;
        progress.aside(|| {
            talk.detail(&format!("projected in {:.1} ms", milliseconds(started)));
            warn_of_polygons_left_out(frame.stats(), talk);
            if self.stats {
                return say(&stats_text(&frame));
            }
            talk.detail(stats_text(&frame).trim_end());
            Ok(())
        })?;
        if talk != Talk::Quiet && matches!(frame.hidden_surfaces(), HiddenSurfaces::Painter(_)) {
            progress.at(0.4, "looking for what the painter draws wrongly");
            let found = conflicts(&frame);
            progress.aside(|| tell_of_conflicts(&found, talk));
        }
        progress.at(0.5, "shading");
        let drawing = progress.aside(|| {
            let content = self.content(&frame, renderer, talk);
            let mut drawing = Drawing::new(frame, content, talk)?;
            let image = file.table().table("image");
            drawing.opaque = image.and_then(|image| image.text("alpha")) == Some("opaque");
            drawing.tell(self.threads.threads, talk);
            Ok::<_, Failure>(drawing)
        })?;
        if let Some(output) = &mut output {
            self.name(output, &drawing)?;
            self.write(&drawing, output, &progress, talk)?;
        }
        let Some(reference) = &self.reference else {
            return Ok(Outcome::Done);
        };
        let check = ReferenceCheck {
            reference,
            threshold: self.reference_threshold,
            written: output.as_ref(),
        };
        let (outcome, text) = check.run(&drawing)?;
        progress.aside(|| say(&text))?;
        Ok(outcome)
    }

    /// Returns the destination of the picture.
    fn output(&self) -> Result<Option<Output>, Failure> {
        if let Some(reference) = &self.reference {
            Format::of_path(reference)?;
        }
        let Some(path) = &self.output else {
            return Ok(None);
        };
        // Wrong placeholders are said before anything is drawn.
        named(path, Default::default())?;
        Output::new(path, self.format).map(Some)
    }

    /// Puts the facts of the picture into its name; refuses to write over its reference.
    fn name(&self, output: &mut Output, drawing: &Drawing) -> Result<(), Failure> {
        let Some(path) = &mut output.path else {
            return Ok(());
        };
        let [width, height] = drawing.size().map(|side| side.to_string());
        let (scene, method) = (scene_name(&self.input), drawing.name());
        *path = named(path, [scene, &method, drawing.engine(), &width, &height])?;
        match &self.reference {
            Some(reference) if same_file(path, reference) => {
                let problem = format!("is the reference itself, {}", reference.display());
                Err(format!("`--output` {problem}: expected another file").into())
            }
            _ => Ok(()),
        }
    }

    /// Writes the picture, and says so.
    fn write(
        &self,
        drawing: &Drawing,
        output: &Output,
        progress: &Progress,
        talk: Talk,
    ) -> Result<(), Failure> {
        let started = Instant::now();
        if output.format == Format::Ppm {
            // Its rows can be written while others are not yet drawn.
            output.write_ppm(drawing.size(), |take| drawing.rows(take))?;
            let spent = milliseconds(started);
            progress.aside(|| talk.detail(&format!("shaded and written in {spent:.1} ms")));
        } else {
            let picture = drawing.picture(output.format == Format::Pfm);
            progress.aside(|| talk.detail(&format!("shaded in {:.1} ms", milliseconds(started))));
            progress.at(0.75, "writing");
            output.write(&picture)?;
        }
        if let Some(path) = &output.path {
            let ([width, height], path, what) = (drawing.size(), path.display(), drawing.name());
            progress.aside(|| talk.note(&format!("{path}: {width}x{height}, {what}")));
        }
        Ok(())
    }

    fn renderer(&self) -> Result<Renderer, Failure> {
        Ok(match self.engine {
            Engine::Scanlines(engine) => renderer(engine, Some(self.simd), Renderer::fastest())?,
            Engine::Barycentric(_) | Engine::Cs171 { .. } => Renderer::LECTURE,
        })
    }

    /// Returns what to draw of `frame`; tells the curious which method `auto` takes.
    fn content(&self, frame: &Frame, renderer: Renderer, talk: Talk) -> Content {
        if let Some(aov) = self.aov {
            return Content::Aov(aov, self.square);
        }
        let (method, why) = self.method.choose(frame, self.engine, renderer);
        if let Some(why) = why {
            talk.detail(&format!("method {method}, by {AUTO}: {why}"));
        }
        Content::Shaded(method, self.engine, self.simd, renderer)
    }
}

/// True if both paths lead to one file that is there.
fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}

fn milliseconds(started: Instant) -> f64 {
    1e3 * started.elapsed().as_secs_f64()
}

/// Warns of polygons that cannot be drawn.
fn warn_of_polygons_left_out(stats: FrameStats, talk: Talk) {
    let (flat, all) = (stats.zero_area, grouped(stats.polygons));
    if flat > 0 {
        let have = if flat == 1 {
            "polygons has"
        } else {
            "polygons have"
        };
        let are = if flat == 1 { "is" } else { "are" };
        let flat = grouped(flat);
        talk.warning(&format!(
            "{flat} of {all} {have} no area and {are} left out"
        ));
    }
    if stats.unprojected > 0 {
        let left_out = counted(
            stats.unprojected,
            "polygon has a corner at the plane of the eye and is left out",
            "polygons have a corner at the plane of the eye and are left out",
        );
        talk.warning(&format!("{left_out}: --clipping planes draws what is seen"));
    }
}

fn tell_of_conflicts(found: &Conflicts, talk: Talk) {
    match painter_text(found) {
        Some(text) => talk.warning(&text),
        None => talk.detail("the painter draws every pair of polygons in the right order"),
    }
}

/// Says what the painter's algorithm draws wrongly, if anything.
fn painter_text(conflicts: &Conflicts) -> Option<String> {
    if conflicts.wrong.is_empty() {
        // A cycle has a pair in the wrong order, whatever the order.
        return None;
    }
    let wrong = counted(conflicts.wrong.len(), "pair is drawn", "pairs are drawn");
    if conflicts.cycles.is_empty() {
        let hope = "though an order exists that is right";
        return Some(format!(
            "{wrong} in the wrong order by the painter's key, {hope}"
        ));
    }
    let in_cycles = conflicts.cycles.iter().map(Vec::len).sum();
    let in_cycles = counted(in_cycles, "polygon", "polygons");
    let cycles = counted(conflicts.cycles.len(), "cycle", "cycles");
    let cutting = match conflicts.interpenetrating {
        0 => String::new(),
        n => format!(", {} each other", counted(n, "pair cuts", "pairs cut")),
    };
    let wrong = format!("{wrong} in the wrong order{cutting}");
    Some(format!(
        "{in_cycles} in {cycles}: no order draws them right; {wrong}"
    ))
}

/// Returns the numbers of polygons as a table.
fn stats_text(frame: &Frame) -> String {
    let stats = frame.stats();
    let row = |name: &str, count, what: &str| [name.to_owned(), grouped(count), what.to_owned()];
    let no_place = "left out: a corner has no place on the picture (--clipping ndc-cube)";
    let cut = "cut by the near plane, the far plane or the guard band";
    let rows = [
        row("polygons", stats.polygons, "of the scene"),
        row(
            "culled",
            stats.culled,
            "left out: seen from the culled side",
        ),
        row(
            "zero-area",
            stats.zero_area,
            "left out: no area, in space or on the picture",
        ),
        row("outside", stats.outside, "left out: outside the view"),
        row("clipped", stats.clipped, cut),
        row("unprojected", stats.unprojected, no_place),
        row(
            "drawn",
            frame.polygons().len(),
            "left, pieces of cut ones counted each",
        ),
    ];
    columns(&rows, false, &[1])
}
