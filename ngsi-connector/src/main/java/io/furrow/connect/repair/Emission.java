package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.LogText;
import io.furrow.connect.repair.LiveEvents.Appended;

/** Hands findings on, a few at a time, and waits until they are durable; so it leaves room to what is told meanwhile. */
final class Emission {
    private static final Logger LOG = LoggerFactory.getLogger(Emission.class);

    private static final int AT_ONCE = 100;
    private static final int BYTES_AT_ONCE = 1024 * 1024;
    private static final Duration FULL_PAUSE = Duration.ofMillis(50);
    private static final Duration LONGEST_PAUSE = Duration.ofMillis(100);

    private final RepairOutput output;
    private final LiveEvents live;
    private final KnownEntities known;
    private final String subscription;

    Emission(RepairOutput output, LiveEvents live, KnownEntities known, String subscription) {
        this.output = output;
        this.live = live;
        this.known = known;
        this.subscription = subscription;
    }

    private record Serialized(Finding finding, byte[] bytes) {
        EntityRecord record() {
            return finding.record();
        }
    }

    /**
     * Emits what is news.
     *
     * @param asked the {@link LiveEvents#now} before the context broker was asked
     * @return how many were emitted
     */
    int emit(List<? extends Finding> findings, long asked) throws InterruptedException, IOException {
        int emitted = 0;
        List<Serialized> some = new ArrayList<>();
        long bytes = 0;
        for (Finding finding : findings) {
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
        // As long as it took, so that at most half of the journal's time goes to the repair.
        long pause = Math.min(LONGEST_PAUSE.toNanos(), System.nanoTime() - begin);
        Thread.sleep(Duration.ofNanos(pause).toMillis());
        return emitted;
    }

    private static void await(CompletableFuture<Void> durable) throws InterruptedException, IOException {
        try {
            durable.get();
        } catch (ExecutionException e) {
            throw new IOException("what was repaired did not become durable: " + e.getCause(), e.getCause());
        }
    }

    private void note(Finding finding) throws IOException {
        if (finding.record().gone()) {
            known.remove(finding.identity());
        } else {
            known.add(finding.identity());
        }
    }

    private static void report(Finding finding) {
        if (finding instanceof Finding.Unreadable dead) {
            LOG.warn(
                    "entity {} of {} is a dead letter: {}",
                    LogText.oneLine(dead.entityId()),
                    dead.state().scope(),
                    LogText.oneLine(dead.problem()));
        }
    }
}
