package io.furrow.suite.page;

import java.util.HashMap;
import java.util.Map;
import java.util.StringJoiner;

import com.microsoft.playwright.CDPSession;

/**
 * The page on a crowded farm of stubs: robots of thirty missions on two farms report once a second, and each second an
 * alarm of forty ends and another begins. Half of the robots of the second farm are silent.
 */
final class Crowd implements AutoCloseable {
    private static final int MISSIONS = 30;
    private static final int ALARMS = 40;
    private static final int MILLIS_BETWEEN_FRAMES = 50;
    private static final int FRAMES_IN_A_SECOND = 1000 / MILLIS_BETWEEN_FRAMES;
    private static final long HOUR = 3_600_000;
    private static final String ID = "urn:ngsi-ld:Robot:";
    /** Is selected. */
    private static final int CHOSEN = 7;

    private static final String IS_SHOWN = """
            async () => {
              const { store } = await import('/core/store.js');
              return store.entities.size >= %d && store.lists.missions.loading === false && document.querySelector('furrow-map')?.devices?.byId.size > 0
                && document.querySelector('furrow-cards li.card.device') !== null && document.querySelector('furrow-alarms li.alarm') !== null;
            }""";
    /** Counts how often the button of the selected robot is elsewhere than in the frame before. */
    private static final String WATCH = """
            (id) => {
              Object.assign(window, { moves: 0, shift: 0, shifts: 0, drawn: 0 });
              let place = null;
              const look = () => {
                const { x, y } = document.querySelector(`li.card[data-id="${id}"] .card-commands .button`).getBoundingClientRect();
                window.moves += place !== null && place !== `${x} ${y}`;
                place = `${x} ${y}`;
                requestAnimationFrame(look);
              };
              look();
              new PerformanceObserver((list) => list.getEntries().forEach(({ value }) => {
                window.shift = Math.max(window.shift, value);
                window.shifts += value;
              })).observe({ type: 'layout-shift' });
              document.querySelector('furrow-map').map.on('postrender', () => window.drawn++);
            }""";

    private final int devices;
    private final Chromium chromium = Chromium.start();
    private final StubFarm farm;
    private FarmPage page;
    private int frames;

    Crowd(int devices) throws Exception {
        this.devices = devices;
        farm = new StubFarm(chromium).hasAlarms(ALARMS);
        StringJoiner missions = new StringJoiner(",", "[", "]");
        for (int mission = 0; mission < MISSIONS; mission++) {
            missions.add("{\"mission\": \"%s\", \"domain\": \"%s\", \"running\": true}"
                    .formatted(mission(mission), domain(mission)));
        }
        farm.answers("/api/missions", missions.toString())
                .answers("/api/domains", "[{\"domain\": \"farm\"}, {\"domain\": \"alps\"}]");
        for (int field = 0; field < MISSIONS; field++) {
            farm.hasField("f" + field, domain(field), longitude(field) + 0.0002, latitude(field));
        }
        for (int number = 0; number < devices; number++) {
            long time = System.currentTimeMillis() - (isSilent(number) ? HOUR : 0);
            farm.has("data.raw", ID + number, robot(number), time);
        }
    }

    /** What a watched time showed. @param millisPerFrame of the main thread, per frame of the map */
    record Watched(int moves, double largestShift, double allShifts, double millisPerFrame) {}

    /** @return ms from the navigation of a new window until robots are on the map, and among the cards, and alarms are shown */
    long open() {
        long startedAt = System.nanoTime();
        page = farm.open("", WindowStyle.DESKTOP.width(), WindowStyle.DESKTOP.height());
        page.until(() -> page.is(IS_SHOWN.formatted(devices)));
        return (System.nanoTime() - startedAt) / 1_000_000;
    }

    /** Selects a robot and reports for a while. */
    Watched watch(int warmUpSeconds, int seconds) {
        page.store("store.select('" + ID + CHOSEN + "')");
        report(warmUpSeconds);
        page.run(WATCH, ID + CHOSEN);
        CDPSession session = page.page().context().newCDPSession(page.page());
        session.send("Performance.enable");
        double tasks = FrameTimes.taskMillis(session);
        report(seconds);
        double time = (FrameTimes.taskMillis(session) - tasks) / page.number("window.drawn");
        return new Watched(
                (int) page.number("window.moves"), page.number("window.shift"), page.number("window.shifts"), time);
    }

    private void report(int seconds) {
        long startedAt = System.currentTimeMillis() - (long) frames * MILLIS_BETWEEN_FRAMES;
        for (int last = frames + seconds * FRAMES_IN_A_SECOND; frames < last; frames++) {
            int within = frames % FRAMES_IN_A_SECOND;
            Map<String, String> records = new HashMap<>();
            for (int number = within; number < devices; number += FRAMES_IN_A_SECOND) {
                if (!isSilent(number)) {
                    records.put(ID + number, robot(number));
                }
            }
            farm.send("data.raw", records);
            if (within == 0) {
                int second = frames / FRAMES_IN_A_SECOND;
                alarm(second % ALARMS + 1, "closed");
                alarm((second + ALARMS / 2) % ALARMS + 1, "open");
            }
            long due = startedAt + (long) (frames + 1) * MILLIS_BETWEEN_FRAMES;
            page.page().waitForTimeout(Math.max(1, due - System.currentTimeMillis()));
        }
    }

    private void alarm(int number, String state) {
        farm.send(
                "service.alarms",
                "a" + number,
                StubFarm.alarm(number, number % 3 == 0 ? "critical" : "warning", state));
    }

    private String robot(int number) {
        double angle = (frames / (double) FRAMES_IN_A_SECOND + number) / 20;
        return StubFarm.robot(
                number,
                "Running",
                domain(number),
                mission(number),
                latitude(number) + 0.00005 * Math.sin(angle),
                longitude(number) + 0.00005 * Math.cos(angle));
    }

    private static boolean isSilent(int number) {
        return number % 4 == 3;
    }

    private static String mission(int number) {
        return "weeding-" + number % MISSIONS;
    }

    private static String domain(int number) {
        return number % 2 == 0 ? "farm" : "alps";
    }

    private static double latitude(int number) {
        return (number % 2 == 0 ? 40.31 : 47.1) + number / 60 * 0.0007;
    }

    private static double longitude(int number) {
        return (number % 2 == 0 ? -3.49 : 10.2) + number % 60 * 0.0003;
    }

    @Override
    public void close() {
        farm.close();
        chromium.close();
    }
}
