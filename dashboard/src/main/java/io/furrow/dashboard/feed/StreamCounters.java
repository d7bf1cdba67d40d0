package io.furrow.dashboard.feed;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import io.furrow.dashboard.http.Problem;

/** Counts events of streams since the dashboard started. */
public final class StreamCounters {
    private final Map<Enum<?>, LongAdder> counts = new ConcurrentHashMap<>();
    private final Map<String, LongAdder> rejections = new ConcurrentHashMap<>();

    /** Events without a reason. */
    public enum Count {
        STREAMS_OPENED("Streams that were opened."),
        RECORDS_READ("Records of topics that were read."),
        RECORDS_SENT("Records that were sent, counted once for each stream."),
        RECORDS_MERGED("Records that a newer one took the place of before they were sent."),
        MESSAGES_WRITTEN("Messages of sockets that Kafka has.");

        private final String help;

        Count(String help) {
            this.help = help;
        }

        public String help() {
            return help;
        }
    }

    /** Reasons for which streams are closed. */
    public enum Closing {
        /** The client closed it or disconnected. */
        CLIENT("client"),
        TOO_SLOW("too-slow"),
        /** The token was revoked, or the user must sign in at the proxy again. */
        USER("user"),
        /** The topic cannot be read. */
        TOPIC("topic"),
        STOPPING("stopping");

        private final String code;

        Closing(String code) {
            this.code = code;
        }

        public String code() {
            return code;
        }
    }

    /** @param event a {@link Count} or a {@link Closing} */
    public void add(Enum<?> event, long by) {
        counts.computeIfAbsent(event, any -> new LongAdder()).add(by);
    }

    public long sum(Enum<?> event) {
        LongAdder count = counts.get(event);
        return count == null ? 0 : count.sum();
    }

    /** Counts a rejected request or message. */
    public void rejected(Problem problem) {
        rejected(problem.error());
    }

    /** @param error code of the rejection */
    public void rejected(String error) {
        rejections.computeIfAbsent(error, any -> new LongAdder()).increment();
    }

    public Map<String, LongAdder> rejections() {
        return Map.copyOf(rejections);
    }
}
