package io.furrow.connect.source.option;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;

import io.furrow.connect.OptionGroup;

/** Options for the answer to notifications for which there is no room, and for the memory that senders may use. */
public record OverloadOptions(AbstractConfig config) {
    static final String ANSWER = "overload.answer";
    public static final String HOLD = "overload.hold.ms";
    public static final String MEMORY = "overload.memory.bytes";
    public static final String TRANSLATION_MEMORY = "translation.memory.bytes";

    /** Bytes of heap per byte of a body: text in the tree, the record, the buffers of both, and the journal's format. */
    public static final int HEAP_PER_BYTE = 6;

    private static final String RESET = "reset";
    private static final String UNAVAILABLE = "503";
    private static final long MIB = 1024 * 1024;
    private static final int SHARE_OF_HEAP = 4;

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Overload");
        group.choice(ANSWER, List.of(RESET, UNAVAILABLE), "Answer")
                .help("Answer to a notification that is not durable in time, or that comes while the source stops:"
                        + " reset resets the connection, which Orion counts in the subscription's failsCounter, so that"
                        + " the gap is visible and can be repaired; 503 with Retry-After is for senders that retry."
                        + " Orion treats any status as success, even 503.");
        group.number(HOLD, 4_000L, Range.between(1, 60_000), "Hold (ms)")
                .help("Milliseconds that a sender is held after its body has arrived until the records are durable;"
                        + " time that its body waits for memory counts too. Less than the sender's own timeout, which"
                        + " is 5 s in Orion unless it was started with another -httpTimeout.");
        group.low()
                .number(MEMORY, 32 * MIB, Range.atLeast(1), "Memory (bytes)")
                .help("Bytes of bodies whose senders have no answer yet; beyond it, further bodies stay in the network"
                        + " and their senders wait. At least " + SizeOptions.MAX_BODY_BYTES + ".");
        group.low()
                .number(TRANSLATION_MEMORY, 0L, Range.atLeast(0), "Translation (bytes)")
                .help("Estimated bytes of heap that notifications may use besides their bodies, from the end of a body"
                        + " to its answer; beyond it, their senders wait. A notification whose own estimate is higher"
                        + " is answered 413 and becomes one dead letter. A body needs at least " + HEAP_PER_BYTE
                        + " times its size, plus an amount for each value in it. 0 for a quarter of the worker's"
                        + " heap.");
    }

    /** Whether a connection is reset rather than answered 503. */
    public boolean resets() {
        return config.getString(ANSWER).equals(RESET);
    }

    public Duration hold() {
        return Duration.ofMillis(config.getLong(HOLD));
    }

    public long memoryBytes() {
        return config.getLong(MEMORY);
    }

    public long translationMemoryBytes() {
        long bytes = config.getLong(TRANSLATION_MEMORY);
        return bytes > 0 ? bytes : Runtime.getRuntime().maxMemory() / SHARE_OF_HEAP;
    }
}
