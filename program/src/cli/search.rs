//! `fastphong search`: searches for the worst cases of methods, on one machine or spread over
//! several.

use super::contents::Contents;
use super::files;
use super::measured::{Methods, command_line, methods};
use super::output::{self, Output};
use super::progress::Progress;
use super::values::number;
use super::{CliError, Log, Outcome, done};
use crate::compare::experiments::{SearchSetting, WorstCase, climb};
use crate::compare::table::Table;
use crate::report::{PartOf, Shard, check_whole};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The schema of the data: see `docs/bench-json.md`.
const SCHEMA: &str = "fastphong.search/1";

/// Search for the worst case of each method: the triangle and lights with the largest error against
/// Phong's picture
#[derive(clap::Args, Debug)]
pub struct SearchArgs {
    /// Methods or groups of methods, separated by commas, as for `compare`
    #[arg(short, long, visible_alias = "method", value_name = "METHODS", default_value = "floats", value_parser = methods)]
    methods: Methods,
    /// Largest angles between the normals of two corners, in degrees, separated by commas, 1 to 90
    /// each
    #[arg(long, value_name = "DEGREES,…", default_value = "5,15,30,60", value_parser = list::<f64>)]
    degrees: List<f64>,
    /// Numbers of lights, separated by commas, 1 to 8 each
    #[arg(long, value_name = "N,…", default_value = "1,4", value_parser = list::<usize>)]
    lights: List<usize>,
    /// Number of restarts of each search, 1 to 100000
    #[arg(long, value_name = "N", default_value = "20", value_parser = |text: &str| number(text, "a number of restarts from 1 to 100000", |n: &u32| (1..=100_000).contains(n)))]
    restarts: u32,
    /// Do part K of N of the restarts; `--from` joins the files of all parts
    #[arg(long, value_name = "K/N", default_value = "1/1", value_parser = Shard::parse)]
    shard: Shard,
    /// Join the `--json` files of all parts of one search, without searching
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["methods", "degrees", "lights", "restarts", "shard"])]
    from: Vec<PathBuf>,
    /// Also write the cases to this file, as described in docs/bench-json.md; `-` prints them
    /// instead of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

type List<T> = Vec<T>;

/// Reads numbers separated by commas, each in the range of its flag, and returns them sorted
/// without duplicates.
fn list<T: Listed>(text: &str) -> Result<Vec<T>, String> {
    let one = |text: &str| number(text.trim(), T::EXPECTED, T::is_in_range);
    let mut all = text.split(',').map(one).collect::<Result<Vec<T>, _>>()?;
    all.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    all.dedup();
    Ok(all)
}

trait Listed: std::str::FromStr + PartialOrd {
    const EXPECTED: &'static str;
    fn is_in_range(&self) -> bool;
}

impl Listed for f64 {
    const EXPECTED: &'static str = "degrees from 1 to 90, separated by commas";
    fn is_in_range(&self) -> bool {
        (1.0..=90.0).contains(self)
    }
}

impl Listed for usize {
    const EXPECTED: &'static str = "numbers of lights from 1 to 8, separated by commas";
    fn is_in_range(&self) -> bool {
        (1..=8).contains(self)
    }
}

/// The worst case found for a method in a setting.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Found {
    method: String,
    #[serde(flatten)]
    setting: SearchSetting,
    /// The restart that found it.
    restart: u32,
    #[serde(flatten)]
    case: WorstCase,
}

/// The result of a run, or of all runs of one search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Document {
    schema: String,
    version: String,
    /// The settings of the search, equal for all its parts.
    run: String,
    shard: Shard,
    restarts: u32,
    command_line: Vec<String>,
    cases: Vec<Found>,
}

impl SearchArgs {
    /// Searches, or joins the results of parts, and prints a table.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let read = self.from.iter().map(|path| Document::read(path));
        let read = read.collect::<Result<Vec<_>, _>>()?;
        let json_to = self.json.as_deref();
        let json_to = json_to.map(|path| Output::new("--json", path, Contents::Json));
        output::check(&json_to.iter().collect::<Vec<_>>())?;
        let document = if read.is_empty() {
            self.search(log)
        } else {
            Document::joined(read, &self.from)?
        };
        let mut json = serde_json::to_string_pretty(&document)?;
        json.push('\n');
        if let Some(json_to) = json_to {
            json_to.write_text(&json)?;
            if json_to.is_stdout() {
                return Ok(Outcome::Done);
            }
        }
        done(&document.table())
    }

    fn search(&self, log: Log) -> Document {
        let mut all = Vec::new();
        for variant in &self.methods {
            for &lights in &self.lights {
                let settings = self.degrees.iter();
                all.extend(settings.map(|&degrees| (variant, SearchSetting { degrees, lights })));
            }
        }
        // This part does every `of`-th restart, beginning at `number`.
        let Shard { number, of } = self.shard;
        let part = (self.restarts + of - number) / of;
        let progress = Progress::watched(log);
        let (count, ended) = (all.len() * part as usize, AtomicUsize::new(0));
        let cases = (0..count)
            .into_par_iter()
            .filter_map(|job| {
                let (variant, setting) = all[job / part as usize];
                let restart = number - 1 + of * (job % part as usize) as u32;
                let case = climb(variant, setting, restart);
                let ended = ended.fetch_add(1, Ordering::Relaxed);
                progress.at(ended as f32 / count as f32, &variant.to_string());
                Some(Found {
                    method: variant.to_string(),
                    setting,
                    restart,
                    case: case?,
                })
            })
            .fold(Worst::default, Worst::with)
            .reduce(Worst::default, |a, b| b.0.into_iter().fold(a, Worst::with));
        let keys = all
            .iter()
            .map(|(variant, setting)| (variant.to_string(), *setting));
        let cases = cases.in_order(&keys.collect::<Vec<_>>());
        for variant in self.methods.iter().map(ToString::to_string) {
            if part > 0 && !cases.iter().any(|found| found.method == variant) {
                log.warning(&format!(
                    "{variant} is left out: it cannot draw these triangles"
                ));
            }
        }
        let names = self.methods.iter().map(ToString::to_string);
        let run = format!(
            "{} {:?} {:?} {}",
            names.collect::<Vec<_>>().join(","),
            self.degrees,
            self.lights,
            self.restarts
        );
        Document {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            run,
            shard: self.shard,
            restarts: self.restarts,
            command_line: command_line(),
            cases,
        }
    }
}

/// The worst case found so far for each method and setting. Of two equally bad cases, the one with
/// the earlier restart counts.
#[derive(Default)]
struct Worst(Vec<Found>);

impl Worst {
    fn with(mut self, found: Found) -> Worst {
        match self.0.iter_mut().find(|other| other.key() == found.key()) {
            None => self.0.push(found),
            Some(other) => {
                let [new, old] = [&found, &*other].map(|f| (f.case.levels, u32::MAX - f.restart));
                if new > old {
                    *other = found;
                }
            }
        }
        self
    }

    /// Returns the cases in the order of `keys`, so that threads do not change the result.
    fn in_order(self, keys: &[(String, SearchSetting)]) -> Vec<Found> {
        let mut cases = self.0;
        let place = |found: &Found| {
            let is_key =
                |(method, setting): &(String, SearchSetting)| (&**method, *setting) == found.key();
            keys.iter().position(is_key)
        };
        cases.sort_by_key(place);
        cases
    }
}

impl Document {
    /// Reads the document of a part.
    fn read(path: &Path) -> Result<Document, CliError> {
        let shown = path.display();
        let text = files::document(path);
        let text = text.map_err(|error| format!("{shown}: cannot be read: {error}"))?;
        let expected = "expected a file of `search --json`";
        let document: Document =
            serde_json::from_str(&text).map_err(|error| format!("{shown}: {error}: {expected}"))?;
        if document.schema != SCHEMA {
            let schema = &document.schema;
            return Err(
                format!("{shown}: its schema is `{schema}`: {expected}, `{SCHEMA}`").into(),
            );
        }
        let Shard { number, of } = document.shard;
        if !document.shard.is_part() {
            return Err(format!("{shown}: it says it is part {number} of {of}: {expected}").into());
        }
        Ok(document)
    }

    /// Joins all parts of one search.
    fn joined(parts: Vec<Document>, paths: &[PathBuf]) -> Result<Document, CliError> {
        let of = |(part, path): (&Document, &PathBuf)| PartOf {
            file: path.display().to_string(),
            run: format!("{} {}", part.version, part.run),
            shard: part.shard,
        };
        check_whole(&parts.iter().zip(paths).map(of).collect::<Vec<_>>())?;
        let first = parts[0].clone();
        // Part 1 has a case for every method and setting, in the order asked for, because it has
        // the first restart.
        let whole = parts.iter().find(|part| part.shard.number == 1);
        let keys = whole.into_iter().flat_map(|part| &part.cases);
        let keys = keys.map(|found| (found.method.clone(), found.setting));
        let keys: Vec<_> = keys.collect();
        let cases = parts.into_iter().flat_map(|part| part.cases);
        let cases = cases.fold(Worst::default(), Worst::with).in_order(&keys);
        Ok(Document {
            shard: Shard::WHOLE,
            command_line: command_line(),
            cases,
            ..first
        })
    }

    /// Returns a table with a row for each method and a column for each setting: the largest
    /// errors, in grey levels.
    fn table(&self) -> String {
        let mut settings: Vec<SearchSetting> = Vec::new();
        let mut names: Vec<&str> = Vec::new();
        for found in &self.cases {
            if !settings.contains(&found.setting) {
                settings.push(found.setting);
            }
            if !names.contains(&found.method.as_str()) {
                names.push(&found.method);
            }
        }
        let head = settings.iter().map(|setting| match setting.lights {
            1 => format!("{}°, 1 light", setting.degrees),
            lights => format!("{}°, {lights} lights", setting.degrees),
        });
        let mut table = Table::new("", &["largest error, levels"]);
        table.head.extend(head);
        table.rows = (names.iter())
            .map(|name| {
                let cells = settings.iter().map(|setting| {
                    let mut cases = self.cases.iter();
                    let found = cases.find(|f| f.method == *name && f.setting == *setting);
                    found.map_or(String::new(), |found| format!("{:.3}", found.case.levels))
                });
                std::iter::once((*name).to_owned()).chain(cells).collect()
            })
            .collect();
        table.text()
    }
}

impl Found {
    fn key(&self) -> (&str, SearchSetting) {
        (&self.method, self.setting)
    }
}
