package io.furrow.flink.time;

import java.time.Duration;
import java.time.Instant;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.job.JobEnvironment;

/**
 * Discards event time of a checkpoint that is after the wall clock by more than the clock skew. Live event time is never
 * that far ahead, so the clock was, and all events until then would be late. Replays may be of any time.
 */
final class RestoredTimeLimit {
    private static final Logger LOG = LoggerFactory.getLogger(RestoredTimeLimit.class);

    private final long latest;
    private boolean reported;

    private RestoredTimeLimit(long latest) {
        this.latest = latest;
    }

    /** Without a limit if the job's parameters have none. */
    static RestoredTimeLimit of(RuntimeContext runtime) {
        String max = runtime.getGlobalJobParameters().get(JobEnvironment.MAX_RESTORED_AHEAD);
        return new RestoredTimeLimit(
                max == null
                        ? Long.MAX_VALUE
                        : System.currentTimeMillis() + Duration.parse(max).toMillis());
    }

    boolean allows(long time) {
        if (time > latest && !reported) {
            reported = true;
            LOG.warn(
                    "the checkpoint has the event time {}, later than now: the clock was set back. Event time begins anew",
                    Instant.ofEpochMilli(time));
        }
        return time <= latest;
    }
}
