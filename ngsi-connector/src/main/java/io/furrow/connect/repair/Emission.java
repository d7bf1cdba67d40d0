package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

/** Hands findings on, a few at a time, and waits until they are durable; so it leaves room to what is told meanwhile. */
final class Emission {
    private static final int AT_ONCE = 100;
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

    /**
     * Emits what was not told since.
     *
     * @param asked by {@link System#nanoTime}, before the context broker was asked
     * @return how many were emitted
     */
    int emit(List<? extends Finding> findings, long asked) throws InterruptedException, IOException {
        int emitted = 0;
        for (int i = 0; i < findings.size(); i += AT_ONCE) {
            long begin = System.nanoTime();
            emitted += emitSome(findings.subList(i, Math.min(findings.size(), i + AT_ONCE)), asked);
            // As long as it took, so that at most half of the journal's time goes to the repair.
            long pause = Math.min(LONGEST_PAUSE.toNanos(), System.nanoTime() - begin);
            Thread.sleep(Duration.ofNanos(pause).toMillis());
        }
        return emitted;
    }

    private record Taken(List<Finding> findings, Optional<CompletableFuture<Void>> durable) {}

    private int emitSome(List<? extends Finding> some, long asked) throws InterruptedException, IOException {
        while (true) {
            Taken taken = live.handOnAlone(() -> {
                List<Finding> left = some.stream()
                        .filter(finding -> !live.cameSince(finding.identity(), asked))
                        .map(Finding.class::cast)
                        .toList();
                return left.isEmpty()
                        ? new Taken(left, Optional.of(CompletableFuture.completedFuture(null)))
                        : new Taken(left, output.emit(subscription, left));
            });
            if (taken.durable().isPresent()) {
                await(taken.durable().get());
                note(taken.findings());
                return taken.findings().size();
            }
            Thread.sleep(FULL_PAUSE.toMillis());
        }
    }

    private static void await(CompletableFuture<Void> durable) throws InterruptedException, IOException {
        try {
            durable.get();
        } catch (ExecutionException e) {
            throw new IOException("what was repaired did not become durable: " + e.getCause(), e.getCause());
        }
    }

    private void note(List<Finding> findings) throws IOException {
        for (Finding finding : findings) {
            if (finding instanceof Finding.Changed changed) {
                live.durable(changed.event().id());
                known.add(changed.identity());
            } else {
                known.remove(finding.identity());
            }
        }
    }
}
