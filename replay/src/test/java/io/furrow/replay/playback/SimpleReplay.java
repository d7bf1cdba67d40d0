package io.furrow.replay.playback;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;

import io.furrow.mission.StoredEvent;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.control.WantedReplay;
import io.furrow.model.event.EventId;

/**
 * The rules of a replay once more, as a program that has the whole mission in memory and goes from one wish to the next; says a line
 * for each record: when it is written, its timestamp, key and headers.
 */
final class SimpleReplay {
    private final List<StoredEvent> recording;
    private final List<String> lines = new ArrayList<>();
    private WantedReplay wanted;
    private List<StoredEvent> pass;
    private boolean open;
    private boolean between;
    private long epoch = -1;
    private long number;
    private long offset;
    private long newestStamp;
    private long stepsDone;
    private long began;
    private long clock;
    private long origin;
    private long reached;

    private SimpleReplay(List<StoredEvent> recording) {
        this.recording = recording;
    }

    static List<String> lines(List<StoredEvent> recording, List<Wishes.Wish> wishes) {
        SimpleReplay replay = new SimpleReplay(recording);
        for (int i = 0; i < wishes.size(); i++) {
            replay.change(wishes.get(i).wanted(), wishes.get(i).at());
            replay.goOn(
                    wishes.get(i).at(),
                    i + 1 < wishes.size() ? wishes.get(i + 1).at() : Long.MAX_VALUE);
        }
        return replay.lines;
    }

    private void change(WantedReplay next, long now) {
        boolean first = wanted == null;
        long position = first ? 0 : position(now);
        boolean jump = next.seek() != null && (first || next.seek().sequence() > wanted.sequence());
        wanted = next;
        clock = now;
        origin = position;
        if (next.step() != null && (jump || next.wanted() != State.PAUSED)) {
            stepsDone = next.step().total();
        }
        if (next.wanted() == State.STOPPED) {
            end("stopped", now);
            between = false;
        } else if (jump) {
            end("seek", now);
            begin(next.seek().to(), now);
        } else if (first) {
            begin(null, now);
        }
    }

    private long position(long now) {
        if (!open || wanted.wanted() == State.PAUSED) {
            return open ? origin : reached;
        }
        double at = origin + Math.floor((now - clock) * wanted.speed());
        return (long) Math.max(reached, Math.min(at, pass.get(0).time()));
    }

    private void begin(Long to, long now) {
        long first = recording.get(0).time();
        long last = recording.get(recording.size() - 1).time();
        long least = wanted.from() == null || wanted.from() < first ? first : wanted.from();
        long most = wanted.to() == null || wanted.to() > last + 1 ? last + 1 : wanted.to();
        long point = to == null || to < least ? least : to > most ? Math.max(least, most) : to;
        epoch++;
        number = 0;
        open = true;
        between = false;
        began = now;
        clock = now;
        origin = point;
        reached = point;
        offset = Math.max(offset, newestStamp - point);
        pass = new ArrayList<>(recording.stream()
                .filter(this::isChosen)
                .filter(event -> event.time() >= point && (wanted.to() == null || event.time() < wanted.to()))
                .toList());
        if (point > first) {
            Missions.known(recording, point).stream()
                    .filter(this::isChosen)
                    .forEach(event -> line(now, "prime", event, point));
        }
    }

    private boolean isChosen(StoredEvent event) {
        return wanted.devices().isEmpty() || wanted.devices().contains(event.entityId());
    }

    private void goOn(long from, long until) {
        long now = from;
        while (open || between) {
            if (between) {
                long next = Math.max(now, began + 1000);
                if (next > until) {
                    return;
                }
                now = next;
                begin(null, now);
            } else if (pass.isEmpty()) {
                end(wanted.loop() ? "loop" : "ended", now);
                between = wanted.loop();
            } else {
                StoredEvent event = pass.get(0);
                boolean paused = wanted.wanted() == State.PAUSED;
                if (paused && (wanted.step() == null || wanted.step().total() <= stepsDone)) {
                    return;
                }
                long due = paused ? now : clock + (long) Math.ceil((event.time() - origin) / wanted.speed());
                if (due > until) {
                    return;
                }
                now = Math.max(now, due);
                if (paused) {
                    stepsDone++;
                    origin = event.time();
                }
                pass.remove(0);
                line(now, "event", event, event.time());
                reached = event.time();
            }
        }
    }

    private void end(String reason, long now) {
        if (open) {
            line(now, "end " + reason, null, reached);
            open = false;
        }
    }

    private void line(long now, String kind, StoredEvent event, long time) {
        newestStamp = time + offset;
        lines.add(String.join(
                " ",
                Long.toString(now),
                Long.toString(newestStamp),
                event == null ? "urn:ngsi-ld:Replay:" + wanted.replay() : event.entityId(),
                kind,
                "epoch " + epoch,
                "sequence " + number++,
                "offset " + offset,
                Instant.ofEpochMilli(time).toString(),
                event == null ? "null" : event.id(),
                EventId.ofReplay(event == null ? "end" : event.id(), wanted.replay(), epoch)));
    }
}
