//! A real sshd on the loopback, with keys and a configuration of its own, gone with its owner.

use std::fs;
use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

/// What to do about a missing tool: no test is skipped in silence.
const HINT: &str = "is not installed; `tests/run` installs it and runs every test";

/// A running sshd.
pub(crate) struct Server {
    daemon: Child,
    port: u16,
    folder: TempDir,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.daemon.kill();
        let _ = self.daemon.wait();
    }
}

/// The tool of that name, which must be there.
pub(crate) fn tool(name: &str) -> String {
    let path = std::env::var("PATH").unwrap_or_default();
    let folders = path.split(':').chain(["/usr/sbin", "/sbin", "/usr/local/sbin"]).map(PathBuf::from);
    let found = folders.map(|folder| folder.join(name)).find(|file| file.is_file());
    found.unwrap_or_else(|| panic!("{name} {HINT}")).to_string_lossy().into_owned()
}

impl Server {
    /// Starts one that lets its own key in, and waits until it listens.
    pub(crate) fn start() -> Server {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for key in ["host", "user"] {
            make_key(&folder.path().join(key));
        }
        let port = free_port();
        let file = folder.path().join("sshd_config");
        fs::write(&file, configuration(folder.path(), port)).expect("a file");
        let mut daemon = Command::new(tool("sshd"))
            .args(["-D", "-e", "-f"])
            .arg(&file)
            .stdin(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("sshd");
        wait_until_it_listens(&mut daemon);
        Server { daemon, port, folder }
    }

    /// The port it listens on.
    pub(crate) fn port(&self) -> u16 {
        self.port
    }

    /// The arguments with which ssh runs `command` there on a terminal of its own, by that port of this machine.
    pub(crate) fn arguments(&self, port: u16, command: &str) -> Vec<String> {
        let user = output(Command::new(tool("id")).arg("-un"));
        let key = self.folder.path().join("user").display().to_string();
        let fixed = ["-tt", "-F", "none", "-o", "StrictHostKeyChecking=no", "-o", "UserKnownHostsFile=/dev/null"];
        let more = ["-o", "LogLevel=ERROR", "-o", "IdentitiesOnly=yes", "-o", "BatchMode=yes", "-i", &key, "-p"];
        let there = [&port.to_string(), "-l", user.trim(), "127.0.0.1", command];
        fixed.into_iter().chain(more).chain(there).map(String::from).collect()
    }

    /// A path on the server's side.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
}

fn make_key(path: &Path) {
    output(Command::new(tool("ssh-keygen")).args(["-q", "-t", "ed25519", "-N", "", "-f"]).arg(path));
}

fn output(command: &mut Command) -> String {
    let ran = command.output().expect("a tool that starts");
    assert!(ran.status.success(), "{command:?}: {}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout).expect("text")
}

fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    listener.local_addr().expect("its address").port()
}

fn configuration(folder: &Path, port: u16) -> String {
    let folder = folder.display();
    format!(
        "Port {port}\nListenAddress 127.0.0.1\nHostKey {folder}/host\nAuthorizedKeysFile {folder}/user.pub\n\
         StrictModes no\nPidFile none\nPermitRootLogin prohibit-password\nPasswordAuthentication no\n\
         KbdInteractiveAuthentication no\nPrintMotd no\nLogLevel INFO\n"
    )
}

/// Reads its log until it listens, and goes on reading, so that it never waits for us.
fn wait_until_it_listens(daemon: &mut Child) {
    let mut log = BufReader::new(daemon.stderr.take().expect("its log")).lines();
    let mut said = String::new();
    loop {
        match log.next() {
            Some(Ok(line)) if line.contains("Server listening") => break,
            Some(Ok(line)) => said += &format!("{line}\n"),
            _ => panic!("sshd did not start; `tests/run` prepares the machine for it. It said:\n{said}"),
        }
    }
    std::thread::spawn(move || log.for_each(drop));
}
