//! A thin and long line between ssh and sshd: a proxy on the loopback that lets so many bits a second through, late.

use std::{
    io::{Read, Write},
    net::{Shutdown, TcpListener, TcpStream},
    sync::mpsc::{self, Receiver, SyncSender},
    thread,
    time::{Duration, Instant},
};

/// Bytes that go through at once: a packet.
const PACKET: usize = 1448;

/// Packets that wait in each direction before the sender has to, as in a router that buffers too much: 370 KB.
const QUEUE: usize = 256;

/// A line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wire {
    /// Each way.
    pub(crate) kilobits: u32,
    /// There and back.
    pub(crate) trip: Duration,
}

/// The lines that are measured.
pub(crate) const THIN: Wire = Wire { kilobits: 256, trip: Duration::from_millis(100) };
pub(crate) const THINNEST: Wire = Wire { kilobits: 64, trip: Duration::from_millis(300) };
pub(crate) const LONG: Wire = Wire { kilobits: 10_000, trip: Duration::from_millis(100) };

impl Wire {
    /// Lays the line to a port of this machine; the port at the near end. It lies until the process ends.
    pub(crate) fn lay(self, to: u16) -> u16 {
        let near = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let port = near.local_addr().expect("its address").port();
        thread::spawn(move || {
            for caller in near.incoming().map_while(Result::ok) {
                let Ok(called) = TcpStream::connect(("127.0.0.1", to)) else { return };
                self.carry(&caller, &called);
                self.carry(&called, &caller);
            }
        });
        port
    }

    /// Carries what comes from one end to the other.
    fn carry(self, from: &TcpStream, to: &TcpStream) {
        let clone = |end: &TcpStream| end.try_clone().expect("a handle of a socket");
        let (from, to) = (clone(from), clone(to));
        from.set_nodelay(true).expect("a socket of ours");
        let (packets, queue) = mpsc::sync_channel(QUEUE);
        thread::spawn(move || self.take(from, &packets));
        thread::spawn(move || deliver(&queue, to));
    }

    /// Reads packets; each gets the moment when it has arrived at the other end.
    fn take(self, mut from: TcpStream, packets: &SyncSender<(Instant, Vec<u8>)>) {
        let (mut bytes, mut free) = ([0; PACKET], Instant::now());
        while let Ok(length @ 1..) = from.read(&mut bytes) {
            let busy = Duration::from_secs_f64(length as f64 * 8.0 / (f64::from(self.kilobits) * 1000.0));
            free = free.max(Instant::now()) + busy;
            if packets.send((free + self.trip / 2, bytes[..length].to_vec())).is_err() {
                return;
            }
        }
    }
}

fn deliver(queue: &Receiver<(Instant, Vec<u8>)>, mut to: TcpStream) {
    for (due, packet) in queue {
        thread::sleep(due.saturating_duration_since(Instant::now()));
        if to.write_all(&packet).is_err() {
            break;
        }
    }
    let _ = to.shutdown(Shutdown::Both); // the other direction may have done it
}

/// How long it takes.
pub(crate) fn timed<T>(what: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = what();
    (done, start.elapsed())
}
