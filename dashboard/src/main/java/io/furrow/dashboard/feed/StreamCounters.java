package io.furrow.dashboard.feed;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import io.furrow.dashboard.http.Problem;

/** What streams did since the dashboard started. Reasons are codes, of which there are few. */
public final class StreamCounters {
    private final Map<Enum<?>, LongAdder> counts = new ConcurrentHashMap<>();
    private final Map<String, LongAdder> refused = new ConcurrentHashMap<>();

    /** What is counted without a reason. */
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

    /** Why a stream is over. */
    public enum Closing {
        /** The client closed it, or is gone. */
        CLIENT("client"),
        TOO_SLOW("too-slow"),
        /** The token was taken back, or the proxy shall be asked again. */
        USER("user"),
        /** Its topic cannot be read. */
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

    /** @param what a {@link Count} or a {@link Closing} */
    public void add(Enum<?> what, long by) {
        counts.computeIfAbsent(what, any -> new LongAdder()).add(by);
    }

    public long sum(Enum<?> what) {
        LongAdder count = counts.get(what);
        return count == null ? 0 : count.sum();
    }

    /** A request or a message was refused. */
    public void refused(Problem problem) {
        refused(problem.error());
    }

    /** @param error a code */
    public void refused(String error) {
        refused.computeIfAbsent(error, any -> new LongAdder()).increment();
    }

    public Map<String, LongAdder> refusals() {
        return Map.copyOf(refused);
    }
}
