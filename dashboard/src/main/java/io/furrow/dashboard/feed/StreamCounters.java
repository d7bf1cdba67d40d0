package io.furrow.dashboard.feed;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import io.furrow.dashboard.http.Problem;

/** What streams did since the dashboard started. Reasons are codes, of which there are few. */
public final class StreamCounters {
    private final LongAdder recordsRead = new LongAdder();
    private final LongAdder recordsSent = new LongAdder();
    private final LongAdder recordsMerged = new LongAdder();
    private final LongAdder messagesWritten = new LongAdder();
    private final LongAdder opened = new LongAdder();
    private final Map<Closing, LongAdder> closed = new ConcurrentHashMap<>();
    private final Map<String, LongAdder> refused = new ConcurrentHashMap<>();

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

    void read() {
        recordsRead.increment();
    }

    public void sent(int records) {
        recordsSent.add(records);
    }

    public void merged() {
        recordsMerged.increment();
    }

    public void written() {
        messagesWritten.increment();
    }

    public void opened() {
        opened.increment();
    }

    public void closed(Closing reason) {
        closed.computeIfAbsent(reason, any -> new LongAdder()).increment();
    }

    /** A request or a message was refused. */
    public void refused(Problem problem) {
        refused(problem.error());
    }

    /** @param error a code */
    public void refused(String error) {
        refused.computeIfAbsent(error, any -> new LongAdder()).increment();
    }

    public long recordsRead() {
        return recordsRead.sum();
    }

    public long recordsSent() {
        return recordsSent.sum();
    }

    public long recordsMerged() {
        return recordsMerged.sum();
    }

    public long messagesWritten() {
        return messagesWritten.sum();
    }

    public long streamsOpened() {
        return opened.sum();
    }

    public long streamsClosed(Closing reason) {
        LongAdder count = closed.get(reason);
        return count == null ? 0 : count.sum();
    }

    public Map<String, LongAdder> refusals() {
        return Map.copyOf(refused);
    }
}
