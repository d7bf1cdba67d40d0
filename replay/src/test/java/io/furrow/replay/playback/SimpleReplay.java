package io.furrow.replay.playback;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;

import io.furrow.mission.Cursor;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.event.EventId;

/**
 * Implements the rules of a replay independently, with the whole mission in memory, from one update to the next. Each
 * record is a line: time of writing, timestamp, key and headers.
 */
final class SimpleReplay {
    private final List<StoredEvent> recording;
    private final List<String> lines = new ArrayList<>();
    private DesiredReplay desired;
    private List<StoredEvent> primes;
    private List<StoredEvent> pass;
    private boolean open;
    private boolean between;
    /** Whether it is at its end, from which it can still step back. */
    private boolean ended;

    private long epoch = -1;
    private long number;
    private long offset;
    private long newestStamp;
    private long stepsDone;
    /** Position after the event up to which a step back plays. */
    private Cursor repeated;

    private boolean played;
    private long beginning;
    private Cursor done;
    private long began;
    private long clock;
    private long origin;
    private long reached;
    /** Whether the gap before the next event has been shortened. */
    private boolean shortened;

    private SimpleReplay(List<StoredEvent> recording) {
        this.recording = recording;
    }

    static List<String> lines(List<StoredEvent> recording, List<DesiredStates.DesiredState> desiredStates) {
        SimpleReplay replay = new SimpleReplay(recording);
        for (int i = 0; i < desiredStates.size(); i++) {
            replay.change(desiredStates.get(i).desired(), desiredStates.get(i).at());
            replay.advance(
                    desiredStates.get(i).at(),
                    i + 1 < desiredStates.size() ? desiredStates.get(i + 1).at() : Long.MAX_VALUE);
        }
        return replay.lines;
    }

    private void change(DesiredReplay next, long now) {
        boolean first = desired == null;
        long position = first ? 0 : position(now);
        boolean onBehindRange = between && desired.range() != null && next.range() == null;
        long rangeEnd = first ? 0 : desired.to();
        boolean jump = next.seek() != null && (first || next.seek().sequence() > desired.sequence());
        desired = next;
        anchor(now, position);
        if (next.step() != null && (jump || !isPaused())) {
            stepsDone = next.step().total();
        }
        repeated = isPaused() ? repeated : null;
        if (next.desired() == State.STOPPED) {
            end("stopped", now);
            between = false;
            ended = false;
        } else if (jump) {
            end("seek", now);
            begin(next.seek().to(), now);
        } else if (onBehindRange) {
            begin(rangeEnd, now);
        } else if (first) {
            begin(null, now);
        }
    }

    private boolean isPaused() {
        return desired.desired() == State.PAUSED;
    }

    private void anchor(long now, long position) {
        Long startAt = desired.plan().startAt();
        clock = startAt == null ? now : Math.max(now, startAt - DesiredStates.wall(0));
        origin = position;
        shortened = false;
    }

    private long position(long now) {
        if (!open || !primes.isEmpty()) {
            return reached;
        }
        if (isPaused() || pass.isEmpty()) {
            return origin;
        }
        shortenGap();
        double at = now <= clock ? origin : origin + Math.floor((now - clock) * desired.speed());
        return (long) Math.max(reached, Math.min(at, pass.get(0).time()));
    }

    /** Shortens the gap before the next event to the maximum. */
    private void shortenGap() {
        Long maxGap = desired.plan().maxGap();
        if (!shortened && maxGap != null) {
            long gap = pass.get(0).time() - Math.max(reached, origin);
            origin += Math.max(0, gap - maxGap);
        }
        shortened = true;
    }

    private void begin(Long to, long now) {
        long first = recording.get(0).time();
        long last = recording.get(recording.size() - 1).time();
        long min = from(first);
        long max = Math.min(last + 1, desired.to());
        long point = to == null || to < min ? min : to > max ? Math.max(min, max) : to;
        epoch++;
        number = 0;
        played = false;
        beginning = point;
        open = true;
        between = false;
        ended = false;
        began = now;
        anchor(now, point);
        reached = point;
        done = Cursor.before(point);
        repeated = null;
        offset = Math.max(offset, newestStamp - point);
        pass = new ArrayList<>(recording.stream()
                .filter(this::isChosen)
                .filter(event -> event.time() >= point)
                .toList());
        primes = new ArrayList<>(point > first ? Missions.stateBefore(recording, point) : List.of());
        primes.removeIf(event -> !isChosen(event));
    }

    private long from(long first) {
        long from = desired.plan().from() == null || desired.plan().from() < first
                ? first
                : desired.plan().from();
        return desired.range() == null ? from : Math.max(from, desired.range().from());
    }

    private boolean isChosen(StoredEvent event) {
        return desired.plan().devices().isEmpty() || desired.plan().devices().contains(event.entityId());
    }

    private void advance(long from, long until) {
        long now = from;
        while (open || between || ended && isPaused() && total() < stepsDone) {
            if (ended) {
                back(now);
            } else if (between) {
                long next = Math.max(now, began + 1000);
                if (next > until) {
                    return;
                }
                now = next;
                begin(null, now);
            } else if (clock > now) {
                if (clock > until) {
                    return;
                }
                now = clock;
            } else if (!primes.isEmpty()) {
                line(now, "prime", primes.remove(0), reached);
            } else if (isPaused() && repeated == null && total() < stepsDone) {
                back(now);
            } else if (pass.isEmpty() || pass.get(0).time() >= desired.to()) {
                repeated = null;
                stepsDone = Math.max(stepsDone, total());
                if (isPaused()) {
                    return;
                }
                boolean again = desired.loops()
                        && (played || beginning > from(recording.get(0).time()));
                end(again ? "loop" : "ended", now);
                between = again;
                ended = !again;
            } else if (isPaused()) {
                if (repeated == null && total() <= stepsDone) {
                    return;
                }
                step(now);
            } else {
                shortenGap();
                StoredEvent event = pass.get(0);
                long due = clock + (long) Math.ceil((event.time() - origin) / desired.speed());
                if (due > until) {
                    return;
                }
                now = Math.max(now, due);
                play(now);
            }
        }
    }

    private long total() {
        return desired.step() == null ? stepsDone : desired.step().total();
    }

    private void step(long now) {
        if (repeated == null) {
            stepsDone++;
        } else if (Cursor.after(pass.get(0)).equals(repeated)) {
            repeated = null;
        }
        anchor(now, pass.get(0).time());
        play(now);
    }

    private void play(long now) {
        StoredEvent event = pass.remove(0);
        line(now, "event", event, event.time());
        played = true;
        reached = event.time();
        done = Cursor.after(event);
        shortened = false;
    }

    private void back(long now) {
        long from = from(recording.get(0).time());
        List<StoredEvent> before = recording.stream()
                .filter(this::isChosen)
                .filter(event -> event.time() >= from && Cursor.after(event).compareTo(done) <= 0)
                .toList();
        int left = before.size() - (int) (stepsDone - total());
        stepsDone = total();
        end("step", now);
        begin(left <= 0 ? null : Long.valueOf(before.get(left - 1).time()), now);
        repeated = left <= 0 ? null : Cursor.after(before.get(left - 1));
    }

    private void end(String reason, long now) {
        if (open) {
            line(now, "end " + reason, null, reached);
            open = false;
        }
    }

    private void line(long now, String kind, StoredEvent event, long time) {
        if (desired.plan().stamps() == ReplayPlan.Stamps.NOW) {
            offset = Math.max(newestStamp, DesiredStates.wall(now)) - time;
        }
        newestStamp = time + offset;
        lines.add(String.join(
                " ",
                Long.toString(now),
                Long.toString(newestStamp),
                event == null ? "urn:ngsi-ld:Replay:" + desired.replay() : event.entityId(),
                kind,
                "epoch " + epoch,
                "sequence " + number++,
                "offset " + offset,
                Instant.ofEpochMilli(time).toString(),
                event == null ? "null" : event.id(),
                EventId.ofReplay(event == null ? "end" : event.id(), desired.replay(), epoch)));
    }
}
