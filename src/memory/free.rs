//! How much more memory this program may take, as Linux reports it: the least of what the system
//! has free, what the limits of the process leave, and what the limits of its control groups leave.

use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

/// Returns how many more bytes of memory this program may ask for, swap included, or `None` if the
/// system does not report it.
pub fn free_memory() -> Option<u64> {
    free_by(&|path| std::fs::read_to_string(path).ok())
}

/// Returns the free memory. `text` reads a file of the system.
fn free_by(text: &dyn Fn(&Path) -> Option<String>) -> Option<u64> {
    let of = |path: &str| text(Path::new(path));
    let (system, swap) = of_system(&of("/proc/meminfo")?)?;
    let process = || of_process(&of("/proc/self/limits")?, &of("/proc/self/status")?);
    let groups = || {
        let groups = folders(&of("/proc/self/cgroup")?, &of("/proc/self/mountinfo")?);
        groups
            .iter()
            .filter_map(|group| group.free(swap, text))
            .min()
    };
    [Some(system), process(), groups()]
        .into_iter()
        .flatten()
        .min()
}

/// Returns the free memory, swap included, and the free swap from the text of `/proc/meminfo`, in
/// bytes.
fn of_system(text: &str) -> Option<(u64, u64)> {
    let free = kilobytes(text, "MemAvailable:")?;
    let swap = kilobytes(text, "SwapFree:").unwrap_or(0);
    Some((free.saturating_add(swap), swap))
}

/// Returns the value of a line such as `VmSize:  5 kB`, in bytes.
fn kilobytes(text: &str, key: &str) -> Option<u64> {
    let value: u64 = text
        .lines()
        .find_map(|line| line.strip_prefix(key))?
        .split_whitespace()
        .next()?
        .parse()
        .ok()?;
    Some(value.saturating_mul(1024))
}

/// Returns what the limits of the process leave, in bytes: the limit of its address space
/// (`ulimit -v`) and of its data (`ulimit -d`). `limits` and `status` are the texts of
/// `/proc/self/limits` and `/proc/self/status`.
fn of_process(limits: &str, status: &str) -> Option<u64> {
    let left = |limit: &str, used: &str| {
        let line = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        let most: u64 = line.split_whitespace().next()?.parse().ok()?;
        Some(most.saturating_sub(kilobytes(status, used)?))
    };
    let space = left("Max address space", "VmSize:");
    let data = left("Max data size", "VmData:");
    space.into_iter().chain(data).min()
}

/// A control group of this program, or one of its ancestors.
#[derive(Debug, PartialEq)]
struct Group {
    folder: PathBuf,
    /// True for the unified hierarchy (version 2).
    is_unified: bool,
}

/// Returns the groups whose limits apply: the group of this program first, then its ancestors.
/// `groups` and `mounts` are the texts of `/proc/self/cgroup` and `/proc/self/mountinfo`.
fn folders(groups: &str, mounts: &str) -> Vec<Group> {
    let mut found = Vec::new();
    for line in mounts.lines() {
        let Some((place, kind)) = line.split_once(" - ") else {
            continue;
        };
        let (place, kind): (Vec<&str>, Vec<&str>) =
            (place.split(' ').collect(), kind.split(' ').collect());
        let ([_, _, _, root, point, ..], [kind, _, options, ..]) = (&place[..], &kind[..]) else {
            continue;
        };
        let is_unified = *kind == "cgroup2";
        let is_memory = *kind == "cgroup" && options.split(',').any(|name| name == "memory");
        if !is_unified && !is_memory {
            continue;
        }
        // A line is `4:memory:/a/b`, or `0::/a/b` in the unified hierarchy.
        let own = groups.lines().find_map(|line| {
            let (controllers, path) = line.split_once(':')?.1.split_once(':')?;
            let is_own = if is_unified {
                controllers.is_empty()
            } else {
                controllers.split(',').any(|name| name == "memory")
            };
            is_own.then_some(path)
        });
        // In a container, the mount may start at the group of the container: its root is then a
        // prefix of the path.
        let Some(within) = own.and_then(|own| Path::new(own).strip_prefix(unescaped(root)).ok())
        else {
            continue;
        };
        let point = PathBuf::from(unescaped(point));
        let innermost = point.join(within);
        let all = innermost
            .ancestors()
            .take_while(|folder| folder.starts_with(&point));
        found.extend(all.map(|folder| Group {
            folder: folder.to_owned(),
            is_unified,
        }));
    }
    found
}

/// Decodes a path of `mountinfo`, where white space and backslashes are written as octal escapes.
fn unescaped(path: &str) -> String {
    let escapes = [
        ("\\040", " "),
        ("\\011", "\t"),
        ("\\012", "\n"),
        ("\\134", "\\"),
    ];
    let replace = |path: String, (from, to): (&str, &str)| path.replace(from, to);
    escapes.into_iter().fold(path.to_owned(), replace)
}

impl Group {
    /// Returns what the limit of this group leaves, in bytes, or `None` without a limit. `swap` is
    /// the free swap of the system, in bytes.
    fn free(&self, swap: u64, text: &dyn Fn(&Path) -> Option<String>) -> Option<u64> {
        let value = |name: &str| -> Option<u64> {
            let text = text(&self.folder.join(name))?;
            text.trim().parse().ok()
        };
        // The kernel counts cached pages of files as used, but frees the inactive ones on demand.
        let reclaimable = || {
            let key = if self.is_unified {
                "inactive_file "
            } else {
                "total_inactive_file "
            };
            let stat = text(&self.folder.join("memory.stat"))?;
            let pages = stat.lines().find_map(|line| line.strip_prefix(key))?;
            pages.trim().parse::<u64>().ok()
        };
        let left = |most: u64, used: Option<u64>| {
            let used = used.unwrap_or(0).saturating_sub(reclaimable().unwrap_or(0));
            most.saturating_sub(used)
        };
        if self.is_unified {
            let free = left(value("memory.max")?, value("memory.current"));
            let most = value("memory.swap.max").unwrap_or(u64::MAX);
            let swapped = value("memory.swap.current").unwrap_or(0);
            return Some(free.saturating_add(swap.min(most.saturating_sub(swapped))));
        }
        let most = value("memory.limit_in_bytes")?;
        let free = left(most, value("memory.usage_in_bytes")).saturating_add(swap);
        // Version 1 may also limit memory and swap together.
        let both = value("memory.memsw.limit_in_bytes")
            .map(|most| left(most, value("memory.memsw.usage_in_bytes")));
        Some(free.min(both.unwrap_or(u64::MAX)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::format;

    const MEMINFO: &str =
        "MemTotal:  24000000 kB\nMemFree:  1 kB\nMemAvailable:   9000 kB\nSwapFree:   1000 kB\n";

    /// Returns the free memory, in units of 1024 bytes, on a system with 10,000 free units and
    /// these files.
    fn free(files: &[(&str, &str)]) -> Option<u64> {
        let text = |path: &Path| {
            let mut all = files.iter().chain(&[("/proc/meminfo", MEMINFO)]);
            let found = all.find(|(name, _)| Path::new(name) == path);
            found.map(|(_, text)| (*text).to_owned())
        };
        free_by(&text).map(|bytes| bytes / 1024)
    }

    #[test]
    fn a_system_without_limits_tells_what_is_free() {
        assert_eq!(free(&[]), Some(10_000));
        assert_eq!(of_system("MemAvailable: 5 kB\n"), Some((5 * 1024, 0)));
        for text in ["", "MemTotal: 5 kB\n", "MemAvailable: many kB\n"] {
            assert_eq!(of_system(text), None, "{text}");
        }
        let is_there = free_memory().is_none_or(|bytes| bytes > 1 << 20);
        assert!(is_there, "a test runs in more than a megabyte");
    }

    #[test]
    fn limits_of_the_process_count_less_what_it_has() {
        let status = ("/proc/self/status", "VmSize:\t 1000 kB\nVmData:\t 200 kB\n");
        let limits = |space: &str, data: &str| {
            let text = format!(
                "Limit  Soft Limit  Hard Limit  Units\nMax data size   {data}   unlimited   bytes\n\
                 Max address space   {space}   unlimited   bytes\n"
            );
            free(&[("/proc/self/limits", &text), status])
        };
        assert_eq!(limits("unlimited", "unlimited"), Some(10_000));
        assert_eq!(limits("2048000", "unlimited"), Some(1000));
        assert_eq!(limits("unlimited", "1024000"), Some(800));
        assert_eq!(limits("1024", "unlimited"), Some(0), "less than there is");
    }

    /// The limits of the program's group and of all its ancestors count, less the memory used there
    /// that cannot be reclaimed.
    #[test]
    fn limits_of_control_groups_count_from_the_own_group_upward() {
        let own = ("/proc/self/cgroup", "1:cpu:/x\n0::/a/b\n");
        let mount = "31 23 0:28 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw,nsdelegate\n";
        let mount = ("/proc/self/mountinfo", mount);
        let file = |name, text| (name, text);
        // 2,000 units, 1,500 of them used, 400 of these reclaimable, and 1,000 of swap.
        let inner = [
            own,
            mount,
            file("/sys/fs/cgroup/a/b/memory.max", "2048000\n"),
            file("/sys/fs/cgroup/a/b/memory.current", "1536000\n"),
            file(
                "/sys/fs/cgroup/a/b/memory.stat",
                "anon 5\ninactive_file 409600\n",
            ),
        ];
        assert_eq!(free(&inner), Some(1900));
        let no_swap = file("/sys/fs/cgroup/a/b/memory.swap.max", "0\n");
        assert_eq!(free(&[&inner[..], &[no_swap]].concat()), Some(900));
        let outer = file("/sys/fs/cgroup/a/memory.max", "307200\n");
        assert_eq!(free(&[&inner[..], &[no_swap, outer]].concat()), Some(900));
        let outer_swap = file("/sys/fs/cgroup/a/memory.swap.max", "0\n");
        assert_eq!(
            free(&[&inner[..], &[outer, outer_swap]].concat()),
            Some(300)
        );
        let none = [own, mount, file("/sys/fs/cgroup/a/b/memory.max", "max\n")];
        assert_eq!(free(&none), Some(10_000));
        // A group that is not an ancestor does not count, even if its name begins alike.
        let other = file("/sys/fs/cgroup/memory.max.d/memory.max", "1\n");
        assert_eq!(free(&[own, mount, other]), Some(10_000));
    }

    /// Version 1, in a container whose mount starts at its own group.
    #[test]
    fn limits_of_older_control_groups_count() {
        let files = [
            ("/proc/self/cgroup", "9:cpuset,memory:/docker/1\n0::/\n"),
            (
                "/proc/self/mountinfo",
                "35 31 0:32 /docker/1 /sys/fs/cgroup/memory\\040x rw,relatime shared:1 - cgroup cgroup rw,memory\n",
            ),
            ("/sys/fs/cgroup/memory x/memory.limit_in_bytes", "1024000\n"),
            ("/sys/fs/cgroup/memory x/memory.usage_in_bytes", "512000\n"),
            (
                "/sys/fs/cgroup/memory x/memory.stat",
                "total_inactive_file 102400\n",
            ),
        ];
        // 1,000 units less 500 used, plus 100 reclaimable and 1,000 of swap.
        assert_eq!(free(&files), Some(1600));
        let both = [
            (
                "/sys/fs/cgroup/memory x/memory.memsw.limit_in_bytes",
                "1126400\n",
            ),
            (
                "/sys/fs/cgroup/memory x/memory.memsw.usage_in_bytes",
                "512000\n",
            ),
        ];
        assert_eq!(free(&[&files[..], &both[..]].concat()), Some(700));
    }
}
