package io.furrow.soak.control;

import java.util.List;
import java.util.Set;
import java.util.function.BooleanSupplier;

/** Measures the time from the start of Kafka and both control planes until both serve requests again. */
final class RecoveryTime {
    private static final Set<String> SERVING = Set.of("ready", "degraded");

    private final BooleanSupplier outage;
    private final List<ControlProcess> controls;
    private long startedAt;
    private boolean recovering;
    private volatile long max;

    /** @param outage whether Kafka or a control plane is unavailable */
    RecoveryTime(BooleanSupplier outage, List<ControlProcess> controls) {
        this.outage = outage;
        this.controls = controls;
    }

    /** Called at short intervals. */
    void step() {
        if (outage.getAsBoolean()) {
            recovering = true;
            startedAt = 0;
            return;
        }
        startedAt = startedAt == 0 ? System.nanoTime() : startedAt;
        if (recovering && controls.stream().allMatch(RecoveryTime::serves)) {
            recovering = false;
            max = Math.max(max, System.nanoTime() - startedAt);
        }
    }

    private static boolean serves(ControlProcess control) {
        return SERVING.contains(control.readiness().path("status").asText());
    }

    double maxSeconds() {
        return max / 1e9;
    }
}
