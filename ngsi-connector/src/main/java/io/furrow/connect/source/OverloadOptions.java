package io.furrow.connect.source;

import java.time.Duration;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.ValidString;
import org.apache.kafka.common.config.ConfigDef.Width;

import io.furrow.connect.Recommendations;

/** What a sender sees when there is no room for its notification, and how much memory senders may take. */
record OverloadOptions(AbstractConfig config) {
    static final String ANSWER = "overload.answer";
    static final String HOLD = "overload.hold.ms";
    static final String MEMORY = "overload.memory.bytes";
    static final String TRANSLATION_MEMORY = "translation.memory.bytes";

    private static final String RESET = "reset";
    private static final String UNAVAILABLE = "503";
    private static final long MIB = 1024 * 1024;
    private static final int SHARE_OF_HEAP = 4;

    static void define(ConfigDef options) {
        String group = "Overload";
        options.define(
                ANSWER,
                Type.STRING,
                RESET,
                ValidString.in(RESET, UNAVAILABLE),
                Importance.MEDIUM,
                "What a sender gets whose notification is not durable in time: reset cuts the connection, which an Orion"
                        + " counts in the subscription's failsCounter, so that the gap shows and can be repaired; 503 with"
                        + " Retry-After is for senders that try again. An Orion takes any status for success, 503 too.",
                group,
                1,
                Width.SHORT,
                "Answer",
                Recommendations.values(RESET, UNAVAILABLE));
        options.define(
                HOLD,
                Type.LONG,
                4_000L,
                Range.between(1, 60_000),
                Importance.MEDIUM,
                "Milliseconds that a sender is held, once its body is there, until there is room and the records are durable; time"
                        + " that its body waits for memory counts too. Less than the sender's own patience, which is 5 s in an Orion unless it was started with another -httpTimeout.",
                group,
                2,
                Width.SHORT,
                "Hold (ms)");
        options.define(
                MEMORY,
                Type.LONG,
                32 * MIB,
                Range.atLeast(1),
                Importance.LOW,
                "Bytes of bodies whose senders have no answer yet; beyond it bodies are left in the network, and their senders"
                        + " wait. At least " + SizeOptions.MAX_BODY_BYTES + ".",
                group,
                3,
                Width.SHORT,
                "Memory (bytes)");
        options.define(
                TRANSLATION_MEMORY,
                Type.LONG,
                0L,
                Range.atLeast(0),
                Importance.LOW,
                "Bytes of heap that notifications may take at a time beside their bodies, by estimate, from the end of a body to"
                        + " its answer; beyond it their senders wait. What is estimated to need more alone is answered 413 and"
                        + " becomes one dead letter. A body needs " + HeapEstimate.PER_BYTE
                        + " times its size, and the more the more values it has. 0 for a quarter of the worker's heap.",
                group,
                4,
                Width.SHORT,
                "Translation (bytes)");
    }

    /** Whether a connection is cut rather than answered 503. */
    boolean resets() {
        return config.getString(ANSWER).equals(RESET);
    }

    Duration hold() {
        return Duration.ofMillis(config.getLong(HOLD));
    }

    long memoryBytes() {
        return config.getLong(MEMORY);
    }

    long translationMemoryBytes() {
        long bytes = config.getLong(TRANSLATION_MEMORY);
        return bytes > 0 ? bytes : Runtime.getRuntime().maxMemory() / SHARE_OF_HEAP;
    }
}
