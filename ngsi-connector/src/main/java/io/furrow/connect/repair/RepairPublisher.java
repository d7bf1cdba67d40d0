package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.repair.RecordTracker.Appended;
import io.furrow.model.text.FailureText;
import io.furrow.model.text.LogText;

/** Emits findings in small batches and waits until they are durable, which leaves room for concurrent notifications. */
record RepairPublisher(RepairOutput output, RecordTracker live, EntityIdSet known, String subscription) {
    private static final Logger LOG = LoggerFactory.getLogger(RepairPublisher.class);

    private static final int AT_ONCE = 100;
    private static final int BYTES_AT_ONCE = 1024 * 1024;
    private static final Duration FULL_PAUSE = Duration.ofMillis(50);
    private static final Duration MAX_PAUSE = Duration.ofMillis(100);

    private record Serialized(MissedChange finding, byte[] bytes) {
        TrackedRecord record() {
            return finding.record();
        }
    }

    /**
     * Emits the new states.
     *
     * @param asked the {@link RecordTracker#now} before the context broker was queried
     * @return the number of emitted records
     */
    int emit(List<? extends MissedChange> findings, long asked) throws InterruptedException, IOException {
        int emitted = 0;
        List<Serialized> some = new ArrayList<>();
        long bytes = 0;
        for (MissedChange finding : findings) {
            if (live.isNews(finding.record(), asked)) {
                Serialized next = new Serialized(finding, output.serialize(subscription, finding));
                if (some.size() == AT_ONCE || !some.isEmpty() && bytes + next.bytes().length > BYTES_AT_ONCE) {
                    emitted += emitSome(some, asked);
                    some = new ArrayList<>();
                    bytes = 0;
                }
                some.add(next);
                bytes += next.bytes().length;
            } else if (!finding.record().gone()) {
                known.add(finding.identity());
            }
        }
        return emitted + emitSome(some, asked);
    }

    private int emitSome(List<Serialized> some, long asked) throws InterruptedException, IOException {
        long begin = System.nanoTime();
        int emitted = 0;
        while (!some.isEmpty()) {
            Appended<Serialized> appended = live.appendNews(
                    some,
                    Serialized::record,
                    asked,
                    news -> output.append(news.stream().map(Serialized::bytes).toList()));
            if (appended.durable().isPresent()) {
                await(appended.durable().get());
                for (Serialized one : appended.found()) {
                    note(one.finding());
                    report(one.finding());
                }
                emitted = appended.found().size();
                break;
            }
            Thread.sleep(FULL_PAUSE.toMillis());
        }
        // Pauses as long as the append took, so that the repair uses at most half of the journal's time.
        long pause = Math.min(MAX_PAUSE.toNanos(), System.nanoTime() - begin);
        Thread.sleep(Duration.ofNanos(pause).toMillis());
        return emitted;
    }

    private static void await(CompletableFuture<Void> durable) throws InterruptedException, IOException {
        try {
            durable.get();
        } catch (ExecutionException e) {
            throw new IOException(
                    "repaired records did not become durable: " + FailureText.of(e.getCause()), e.getCause());
        }
    }

    private void note(MissedChange finding) throws IOException {
        if (finding.record().gone()) {
            known.remove(finding.identity());
        } else {
            known.add(finding.identity());
        }
    }

    private static void report(MissedChange finding) {
        if (finding instanceof MissedChange.Unreadable dead) {
            LOG.warn(
                    "entity {} of {} became a dead letter: {}",
                    LogText.oneLine(dead.entityId()),
                    dead.state().scope(),
                    LogText.oneLine(dead.problem().getMessage()));
        }
    }
}
