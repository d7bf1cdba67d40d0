package io.furrow.connect.source.journal;

import java.time.Duration;
import java.util.List;
import java.util.OptionalLong;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.journal.Corruption;
import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.journal.JournalFolders.Orphan;
import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.ledger.Ledger;

/** The journals that one task has open: its own, and those of tasks that moved away or died. */
public final class TaskJournals implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TaskJournals.class);

    /** Bytes of the records that one poll returns, which keeps memory flat whatever the size of the records. */
    private static final long BYTES_AT_ONCE = 8L * 1024 * 1024;

    /** The committed position of a journal. */
    @FunctionalInterface
    public interface Committed {
        /** The number of the first record that is not confirmed in Kafka; empty if the journal has no offset. */
        OptionalLong of(String journal);
    }

    /** Verifies that Kafka has the acknowledged records. */
    @FunctionalInterface
    public interface Verification {
        /** Trusts the offset store. */
        Verification NONE = (journal, committed) -> committed;

        /**
         * The number of the first record below the committed position that is missing in Kafka; that position if none is.
         * May wait for Kafka.
         */
        long firstMissing(Journal journal, long committed) throws InterruptedException;
    }

    /**
     * The protection against loss of acknowledged records in Kafka.
     *
     * @param retention how long records stay in the journal after they were committed
     */
    public record Safety(Duration retention, Verification verification) {
        public static final Safety NONE = new Safety(Duration.ZERO, Verification.NONE);
    }

    /** Records of one journal, in order. */
    public record Batch(String journal, List<JournalRecord> records) {}

    private final JournalFolders folders;
    private final Safety safety;
    private final Ledger ledger;
    private final UndeliveredRecords left;
    private volatile Committed committed;
    private volatile JournalConsumer own;
    private final List<JournalConsumer> adopted = new CopyOnWriteArrayList<>();
    private final AtomicLong inFlight = new AtomicLong();
    private volatile List<Orphan> orphans = List.of();
    private boolean ownTurn;
    private boolean closed;

    /** Opens the task's own journal, the one of the slot. */
    public TaskJournals(JournalFolders folders, int slot, Committed committed, Safety safety, Ledger ledger) {
        this.folders = folders;
        this.safety = safety;
        this.committed = committed;
        this.ledger = ledger;
        this.left = UndeliveredRecords.of(folders.owner());
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

    private JournalConsumer openOwn(int slot) {
        Journal journal = folders.take(slot);
        try {
            OptionalLong known = committed.of(journal.id());
            if (known.orElse(0) > journal.end()) {
                LOG.info("journal {}: continues at record {}, beyond its end {}", journal.id(), known, journal.end());
                journal.skipTo(known.getAsLong());
            }
            return opened(journal, known);
        } catch (RuntimeException | Error e) {
            journal.close();
            throw e;
        }
    }

    /**
     * Restarts from the committed position, for another task. Records that were returned and not acknowledged are
     * returned again, and then count as recovered.
     */
    public void resume(Committed nowCommitted) {
        committed = nowCommitted;
        long before = pending();
        own = again(own);
        adopted.replaceAll(this::again);
        inFlight.set(0);
        long more = pending() - before;
        (more > 0 ? ledger.recovered : ledger.produced).add(Math.abs(more));
    }

    private JournalConsumer again(JournalConsumer drain) {
        JournalConsumer fresh =
                consumer(drain.journal(), committed.of(drain.journal().id()));
        drain.closeReader();
        return fresh;
    }

    private JournalConsumer opened(Journal journal, OptionalLong known) {
        JournalConsumer drain = consumer(journal, known);
        left.take(journal.folder());
        ledger.recovered.add(drain.left());
        for (Corruption damage : journal.damages()) {
            if (damage.kind() == Corruption.Kind.MISSING) {
                long missing = damage.sequence() + damage.records() - Math.max(damage.sequence(), drain.start());
                ledger.recovered.add(Math.max(0, missing));
                ledger.lost.add(Math.max(0, missing));
            }
        }
        return drain;
    }

    private JournalConsumer consumer(Journal journal, OptionalLong known) {
        long committed = known.orElse(0);
        long first = committed;
        try {
            first = safety.verification().firstMissing(journal, Math.min(committed, journal.end()));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        if (first >= Math.min(committed, journal.end())) {
            return new JournalConsumer(journal, known, safety.retention());
        }
        LOG.warn(
                "journal {}: Kafka acknowledged record {} but does not have it any more; sending records from there to {} again",
                journal.id(),
                first,
                committed);
        return new JournalConsumer(journal, first, committed, safety.retention());
    }

    /** The journal to which new records are appended. */
    public Journal own() {
        return own.journal();
    }

    /** The next records; waits for the first. The own journal and the others take turns. */
    public Batch next(int maxRecords, Duration wait) throws InterruptedException {
        ownTurn = !ownTurn;
        if (!ownTurn) {
            for (JournalConsumer drain : adopted) {
                Batch turn = turnOf(drain, maxRecords, Duration.ZERO);
                if (!turn.records().isEmpty()) {
                    return turn;
                }
            }
        }
        boolean othersHaveNone = adopted.stream().allMatch(drain -> drain.left() == 0);
        return turnOf(own, maxRecords, othersHaveNone ? wait : Duration.ZERO);
    }

    private Batch turnOf(JournalConsumer drain, int maxRecords, Duration wait) throws InterruptedException {
        long lostBefore = drain.lost();
        int damagesBefore = drain.journal().damages().size();
        List<JournalRecord> records = drain.read(maxRecords, BYTES_AT_ONCE, wait);
        inFlight.addAndGet(records.size());
        ledger.lost.add(drain.lost() - lostBefore);
        ledger.corrupt.add(drain.journal().damages().size() - damagesBefore);
        return new Batch(drain.journal().id(), records);
    }

    /** Kafka has acknowledged a record. */
    public void produced(String journal, long sequence) {
        ledger.produced.increment();
        inFlight.decrementAndGet();
        own.acknowledged(journal, sequence);
        adopted.forEach(drain -> drain.acknowledged(journal, sequence));
    }

    /** The worker skipped a record, which is then complete, too. */
    public void skipped(String journal, long sequence) {
        ledger.skipped.increment();
        inFlight.decrementAndGet();
        all().filter(drain -> drain.journal().id().equals(journal)).forEach(drain -> drain.skip(sequence));
    }

    /** Releases the records that the offset store reports in Kafka. May wait for Kafka. */
    void release() {
        all().toList()
                .forEach(drain -> release(drain, committed.of(drain.journal().id())));
    }

    /** A journal that was closed meanwhile may belong to another task, also as its own journal. */
    private synchronized void release(JournalConsumer drain, OptionalLong known) {
        if (!closed && drain.release(known) && adopted.remove(drain)) {
            LOG.info(
                    "journal {} of another task is in Kafka to its end",
                    drain.journal().id());
            drain.delete();
        }
    }

    /** Adopts journals that no task has open, and lists those that no task will open. May wait for Kafka. */
    void adopt() {
        folders.adopt(journal -> takeOver(journal, committed.of(journal.id())));
        orphans = folders.orphans();
    }

    private synchronized void takeOver(Journal journal, OptionalLong known) {
        if (closed) {
            journal.close();
            return;
        }
        JournalConsumer drain = opened(journal, known);
        adopted.add(drain);
        LOG.info("journal {} was left by another task and is taken over: {} records", journal.id(), drain.left());
    }

    public List<Orphan> orphans() {
        return orphans;
    }

    private Stream<JournalConsumer> all() {
        return Stream.concat(Stream.of(own), adopted.stream());
    }

    private long pending() {
        return inFlight.get() + all().mapToLong(JournalConsumer::left).sum();
    }

    private long bytes() {
        return all().mapToLong(drain -> drain.journal().bytes()).sum();
    }

    /** Releases the journals for other tasks, and reports how many of their records are not in Kafka. */
    @Override
    public synchronized void close() {
        closed = true;
        all().forEach(drain -> {
            drain.close();
            left.leave(drain.journal().folder(), drain.notReleased());
        });
    }
}
