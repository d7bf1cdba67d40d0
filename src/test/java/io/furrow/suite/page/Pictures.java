package io.furrow.suite.page;

import java.nio.file.Path;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** Takes screenshots of the main views for the documentation. */
final class Pictures {
    private static final String ENCOUNTER =
            "[...store.encounters.values()].some((each) => ['started', 'ongoing'].includes(each.phase) && each.distance < 4.8)";

    private static final String SKELETON = ".skeleton:visible";

    private Pictures() {}

    static boolean take(PageSuite suite, Path folder) {
        replay(suite, folder); // waits for a recording, so that the other views have some minutes to show
        live(suite, folder, "live-dark", WindowStyle.DESKTOP);
        live(suite, folder, "live-tablet", WindowStyle.TABLET);
        live(suite, folder, "live-phone", WindowStyle.PHONE);
        for (String view : new String[] {"missions", "replays", "analyses", "topics", "platform"}) {
            view(suite, folder, view, WindowStyle.DESKTOP, "-dark");
        }
        view(suite, folder, "analyses", WindowStyle.DESKTOP_LIGHT, "-light");
        view(suite, folder, "missions", WindowStyle.PHONE_LIGHT, "-phone");
        return true;
    }

    private static void live(PageSuite suite, Path folder, String name, WindowStyle style) {
        FarmPage farm = suite.open("", style);
        farm.untilStore(
                "store.averages.has('field-1') && store.entities.get('urn:ngsi-ld:Robot:1')?.trail.length > 40");
        assertThat(farm.card("urn:ngsi-ld:Robot:1")).isVisible();
        assertThat(farm.find(SKELETON)).hasCount(0);
        farm.untilStore(ENCOUNTER);
        save(farm, folder, name);
    }

    private static void replay(PageSuite suite, Path folder) {
        FarmPage farm = suite.open("#/replays", WindowStyle.DESKTOP_LIGHT);
        for (int millis = 30_000;
                millis <= 90_000;
                millis += 30_000) { // the list of recordings is updated every half minute
            farm.untilStore(
                    "store.recordings.get('weeding')?.last - store.recordings.get('weeding')?.first > " + millis);
        }
        farm.page().getByLabel("Choose weeding").check();
        farm.page().getByLabel("Speed").first().selectOption("2");
        farm.button("Start replay").click();
        assertThat(farm.find(".mode")).containsText("Replay of weeding");
        farm.untilStore("store.mode.position - store.mode.from > 20000 && store.entities.size > 4");
        farm.untilStore(ENCOUNTER);
        save(farm, folder, "replay-light");
    }

    private static void view(PageSuite suite, Path folder, String view, WindowStyle style, String suffix) {
        FarmPage farm = suite.open("#/" + view, style);
        farm.untilStore("store.entities.size >= 17");
        if (view.equals("topics")) {
            farm.find("[id='topic-data.farm.realtime.weeding']").check();
            farm.find("[id='topic-data.collision']").check();
            assertThat(farm.find("furrow-topics table tbody tr").nth(8)).isVisible();
        }
        if (view.equals("replays")) {
            farm.page().getByLabel("Choose weeding").check();
        }
        assertThat(farm.find(SKELETON)).hasCount(0);
        farm.page().waitForTimeout(2_000);
        save(farm, folder, view + suffix);
    }

    private static void save(FarmPage farm, Path folder, String name) {
        farm.page().mouse().move(2, 2);
        farm.screenshot(folder.resolve(name + ".png"));
        PageSoak.print("%s", folder.resolve(name + ".png"));
        farm.close();
    }
}
