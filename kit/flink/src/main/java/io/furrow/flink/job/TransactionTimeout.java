package io.furrow.flink.job;

import java.time.Duration;

/** The timeout of a job's transactions at the broker. A transaction lasts from one checkpoint to the next. */
public final class TransactionTimeout {
    private static final String PROPERTY = "transaction.timeout.ms";
    /** Below the broker's default limit of 15 min. */
    private static final Duration DEFAULT = Duration.ofMinutes(10);
    /** Time to complete a checkpoint until its transactions have ended. */
    private static final Duration COMMIT = Duration.ofMinutes(1);

    private TransactionTimeout() {}

    /** From {@code --kafka-properties}, else 10 min. */
    public static Duration of(JobOptions options) {
        String given = options.kafkaProperties().getProperty(PROPERTY);
        try {
            return given == null ? DEFAULT : Duration.ofMillis(Long.parseLong(given.trim()));
        } catch (NumberFormatException e) {
            throw options.refused(
                    "--kafka-properties: " + PROPERTY + " '" + given + "' is not a whole number; write milliseconds",
                    e);
        }
    }

    /** @param interval of checkpoints, whatever its origin */
    static void check(JobOptions options, Duration interval) {
        if (options.delivery() != Delivery.EXACTLY_ONCE) {
            return;
        }
        Duration timeout = of(options);
        if (interval.plus(COMMIT).compareTo(timeout) > 0) {
            throw options.refused(
                    "--delivery exactly-once: checkpoints are " + interval.toSeconds() + " s apart, and the broker ends"
                            + " transactions after " + timeout.toSeconds() + " s; leave a minute between them, by"
                            + " --checkpoint-interval or by " + PROPERTY + " in --kafka-properties",
                    null);
        }
    }
}
