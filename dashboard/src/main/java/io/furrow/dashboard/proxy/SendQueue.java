package io.furrow.dashboard.proxy;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Queue;

import io.furrow.dashboard.feed.FeedRecord;
import io.furrow.dashboard.feed.InitialState;
import io.furrow.dashboard.feed.StateBudget;
import io.furrow.dashboard.feed.StreamCounters;
import io.furrow.dashboard.feed.StreamCounters.Count;
import io.furrow.dashboard.feed.StreamLimits;

/**
 * Queues the records that wait to be sent on one stream, within bounds. Records that arrive before the initial state
 * wait behind it.
 */
final class SendQueue {
    private static final int FRAME_CHARS = 256 * 1024;

    private final StreamRequest request;
    private final StreamLimits limits;
    private final StreamCounters counters;
    private final Queue<FeedRecord> initial = new ArrayDeque<>();
    private final Queue<FeedRecord> all = new ArrayDeque<>();
    private final Map<String, FeedRecord> latest = new LinkedHashMap<>();
    private final Queue<String> controlFrames = new ArrayDeque<>();
    private long bytes;
    private long merged;
    private boolean priming;
    private boolean overflown;
    /** Of the initial state; null unless some of it waits. */
    private StateBudget.Share share;

    private boolean closed;

    SendQueue(StreamRequest request, StreamLimits limits, StreamCounters counters) {
        this.request = request;
        this.limits = limits;
        this.counters = counters;
        this.priming = request.prime();
    }

    /** @return false if the queue is full: the stream must be closed */
    synchronized boolean offer(FeedRecord record) {
        if (request.mode() == StreamRequest.Mode.ALL) {
            all.add(record);
        } else {
            String key = record.key();
            // the record must stay behind a deletion that precedes it
            FeedRecord older = latest.containsKey(record.keyWithoutType()) ? latest.remove(key) : null;
            FeedRecord replaced = latest.put(key, record);
            older = older == null ? replaced : older;
            if (older != null) {
                bytes -= older.bytes();
                merged++;
                counters.add(Count.RECORDS_MERGED, 1);
            }
        }
        bytes += record.bytes();
        overflown = overflown || all.size() + latest.size() > limits.waitingRecords() || bytes > limits.waitingBytes();
        return !overflown;
    }

    /** Adds the initial state. */
    synchronized void prime(InitialState.State state) {
        initial.addAll(state.records());
        share = state.share();
        releaseSent();
        if (request.format() == StreamRequest.Format.RECORD) {
            // sent after the initial state, whose frames are polled first
            controlFrames.add("{\"primed\":true}");
        }
        priming = false;
    }

    /** Drops the initial state, now or when it is added. */
    synchronized void close() {
        closed = true;
        releaseSent();
    }

    private void releaseSent() {
        if (closed) {
            initial.clear();
        }
        if (share != null && initial.isEmpty()) {
            share.release();
            share = null;
        }
    }

    /** Adds a short frame without records. */
    synchronized void addControlFrame(String frame) {
        controlFrames.add(frame);
    }

    /** The next frame; null if none waits. */
    synchronized String poll() {
        if (!initial.isEmpty()) {
            String frame = frame(initial.iterator(), false);
            releaseSent();
            return frame;
        } else if (!controlFrames.isEmpty()) {
            return controlFrames.remove();
        } else if (priming || all.isEmpty() && latest.isEmpty()) {
            return null;
        }
        return frame(all.isEmpty() ? latest.values().iterator() : all.iterator(), true);
    }

    private String frame(Iterator<FeedRecord> waiting, boolean counted) {
        if (request.format() == StreamRequest.Format.VALUE) {
            counters.add(Count.RECORDS_SENT, 1);
            return remove(waiting, counted).text();
        }
        List<String> records = new ArrayList<>();
        int chars = 0;
        while (waiting.hasNext() && chars < FRAME_CHARS) {
            String record = remove(waiting, counted).envelope();
            records.add(record);
            chars += record.length();
        }
        counters.add(Count.RECORDS_SENT, records.size());
        String tail = counted && merged > 0 ? "],\"merged\":" + merged + "}" : "]}";
        merged = counted ? 0 : merged;
        return "{\"records\":[" + String.join(",", records) + tail;
    }

    private FeedRecord remove(Iterator<FeedRecord> waiting, boolean counted) {
        FeedRecord record = waiting.next();
        waiting.remove();
        bytes -= counted ? record.bytes() : 0;
        return record;
    }
}
