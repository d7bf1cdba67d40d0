package io.furrow.connect.source;

import java.time.Duration;
import java.util.List;
import java.util.OptionalLong;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.journal.Damage;
import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.journal.JournalFolders.Orphan;
import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.ledger.Ledger;

/** The journals that one task has open: its own, and those that tasks left behind which moved away or died. */
final class TaskJournals implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TaskJournals.class);

    /** Records that one turn hands on, in bytes, so that memory stays flat whatever their size. */
    private static final long BYTES_AT_ONCE = 8L * 1024 * 1024;

    /** What Kafka knows of a journal. */
    @FunctionalInterface
    interface Committed {
        /** The number of the first record that is not known to be in Kafka; empty if nothing is known of the journal. */
        OptionalLong of(String journal);
    }

    /** Records of one journal, in their order. */
    record Turn(String journal, List<JournalRecord> records) {}

    private final JournalFolders folders;
    private final Ledger ledger;
    private final LeftRecords left;
    private volatile Committed committed;
    private volatile JournalDrain own;
    private final List<JournalDrain> adopted = new CopyOnWriteArrayList<>();
    private final AtomicLong inFlight = new AtomicLong();
    private volatile List<Orphan> orphans = List.of();
    private boolean ownTurn;
    private boolean closed;

    /** Opens the own journal, the one of the slot. */
    TaskJournals(JournalFolders folders, int slot, Committed committed, Ledger ledger) {
        this.folders = folders;
        this.committed = committed;
        this.ledger = ledger;
        this.left = LeftRecords.of(folders.owner());
        this.own = openOwn(slot);
        ledger.gauge("pending", "Records on disk that Kafka has not acknowledged", this::pending);
        ledger.gauge("journalBytes", "Bytes on disk of the journals", this::bytes);
        ledger.gauge(
                "waitingBytes",
                "Bytes of records that wait for the disk",
                () -> own.journal().waitingBytes());
        ledger.gauge("adoptedJournals", "Journals of other tasks that are being drained", adopted::size);
        ledger.gauge(
                "orphanedJournals", "Journals below the journal folder that no task has open", () -> orphans.size());
        ledger.gauge(
                "orphanedBytes",
                "Bytes on disk of the orphaned journals",
                () -> orphans.stream().mapToLong(Orphan::bytes).sum());
    }

    private JournalDrain openOwn(int slot) {
        Journal journal = folders.take(slot);
        try {
            OptionalLong known = committed.of(journal.id());
            if (known.orElse(0) > journal.end()) {
                LOG.info("journal {}: goes on at record {}, beyond its end {}", journal.id(), known, journal.end());
                journal.skipTo(known.getAsLong());
            }
            return opened(journal, known);
        } catch (RuntimeException | Error e) {
            journal.close();
            throw e;
        }
    }

    /**
     * Begins again where Kafka left off, for another task. What was handed on and not acknowledged is handed on again, and then
     * counts as recovered.
     */
    void resume(Committed nowCommitted) {
        committed = nowCommitted;
        long before = pending();
        own = again(own);
        adopted.replaceAll(this::again);
        inFlight.set(0);
        long more = pending() - before;
        (more > 0 ? ledger.recovered : ledger.produced).add(Math.abs(more));
    }

    private JournalDrain again(JournalDrain drain) {
        JournalDrain fresh =
                new JournalDrain(drain.journal(), committed.of(drain.journal().id()));
        drain.closeReader();
        return fresh;
    }

    private JournalDrain opened(Journal journal, OptionalLong known) {
        JournalDrain drain = new JournalDrain(journal, known);
        left.take(journal.folder());
        ledger.recovered.add(drain.left());
        for (Damage damage : journal.damages()) {
            if (damage.kind() == Damage.Kind.MISSING) {
                long missing = damage.sequence() + damage.records() - Math.max(damage.sequence(), drain.start());
                ledger.recovered.add(Math.max(0, missing));
                ledger.lost.add(Math.max(0, missing));
            }
        }
        return drain;
    }

    /** The journal that new records go to. */
    Journal own() {
        return own.journal();
    }

    /** The next records; waits for the first. Its own journal and the others take turns. */
    Turn next(int maxRecords, Duration wait) throws InterruptedException {
        ownTurn = !ownTurn;
        if (!ownTurn) {
            for (JournalDrain drain : adopted) {
                Turn turn = turnOf(drain, maxRecords, Duration.ZERO);
                if (!turn.records().isEmpty()) {
                    return turn;
                }
            }
        }
        boolean othersHaveNone = adopted.stream().allMatch(drain -> drain.left() == 0);
        return turnOf(own, maxRecords, othersHaveNone ? wait : Duration.ZERO);
    }

    private Turn turnOf(JournalDrain drain, int maxRecords, Duration wait) throws InterruptedException {
        long lostBefore = drain.lost();
        int damagesBefore = drain.journal().damages().size();
        List<JournalRecord> records = drain.read(maxRecords, BYTES_AT_ONCE, wait);
        inFlight.addAndGet(records.size());
        ledger.lost.add(drain.lost() - lostBefore);
        ledger.corrupt.add(drain.journal().damages().size() - damagesBefore);
        return new Turn(drain.journal().id(), records);
    }

    /** Kafka has acknowledged a record that was handed on. */
    void produced() {
        ledger.produced.increment();
        inFlight.decrementAndGet();
    }

    /** The worker left out a record that was handed on: that is the end of it, too. */
    void skipped(String journal, long sequence) {
        ledger.skipped.increment();
        inFlight.decrementAndGet();
        all().filter(drain -> drain.journal().id().equals(journal)).forEach(drain -> drain.skip(sequence));
    }

    /** Frees what the offset store says is in Kafka. May wait for Kafka. */
    void release() {
        all().toList()
                .forEach(drain -> release(drain, committed.of(drain.journal().id())));
    }

    /** What was closed meanwhile may be another task's, also as its own journal. */
    private synchronized void release(JournalDrain drain, OptionalLong known) {
        if (!closed && drain.release(known) && adopted.remove(drain)) {
            LOG.info(
                    "journal {} of another task is in Kafka to its end",
                    drain.journal().id());
            drain.delete();
        }
    }

    /** Takes over journals that nobody has open, and looks for those that nobody will. May wait for Kafka. */
    void adopt() {
        folders.adopt(journal -> takeOver(journal, committed.of(journal.id())));
        orphans = folders.orphans();
    }

    private synchronized void takeOver(Journal journal, OptionalLong known) {
        if (closed) {
            journal.close();
            return;
        }
        JournalDrain drain = opened(journal, known);
        adopted.add(drain);
        LOG.info("journal {} was left by another task and is taken over: {} records", journal.id(), drain.left());
    }

    List<Orphan> orphans() {
        return orphans;
    }

    private Stream<JournalDrain> all() {
        return Stream.concat(Stream.of(own), adopted.stream());
    }

    private long pending() {
        return inFlight.get() + all().mapToLong(JournalDrain::left).sum();
    }

    private long bytes() {
        return all().mapToLong(drain -> drain.journal().bytes()).sum();
    }

    /** Lets other tasks have them, and shows how much of them is not in Kafka. */
    @Override
    public synchronized void close() {
        closed = true;
        all().forEach(drain -> {
            drain.close();
            left.leave(drain.journal().folder(), drain.notReleased());
        });
    }
}
