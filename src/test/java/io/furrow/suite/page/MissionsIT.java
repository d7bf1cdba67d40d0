package io.furrow.suite.page;

import java.util.List;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.APIResponse;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.options.FilePayload;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.EXACTLY;
import static io.furrow.suite.page.FarmPage.having;
import static java.nio.charset.StandardCharsets.UTF_8;

/** The life cycle of missions, and the audit. */
@PageTest
class MissionsIT {
    private static final String MEADOW = """
            {"type":"FeatureCollection","features":[{"type":"Feature","id":"meadow","properties":{"name":"Far meadow"},
            "geometry":{"type":"Polygon","coordinates":[[[9.0,50.0],[9.001,50.0],[9.001,50.001],[9.0,50.001],[9.0,50.0]]]}}]}""";

    @Test
    void createsChecksStartsAndStopsAMission(PageSuite suite) {
        // A mission that has just started has no stored events.
        FarmPage farm = suite.open("#/missions").expectingError("status of 400.*recordings/again/timeline");
        farm.button("New mission").click();
        Locator dialog = farm.find("dialog[open]");
        dialog.getByLabel("Name").fill("again");
        dialog.getByLabel("Domain").selectOption("farm");
        dialog.getByLabel("Template").selectOption("demo-scouting@1");
        // Its devices are used by another mission.
        assertThat(dialog).containsText("are in the way");
        assertThat(dialog).containsText("runs in mission scouting");
        dialog.getByLabel("Template").selectOption("thesis-demo@1");
        dialog.getByText("Create", EXACTLY).click();

        Locator detail = farm.find("furrow-missions .mission-detail");
        assertThat(detail).containsText("again");
        assertThat(detail.locator(".pill").first()).hasText("running");
        assertThat(detail.locator(".device-table tbody tr").first()).isVisible();
        detail.getByText("Stop", EXACTLY).click();
        dialog.getByText("Stop", EXACTLY).click();
        assertThat(detail.locator(".pill").first()).hasText("stopped");

        assertThat(detail.locator("table").last()).containsText("mission start");
        assertThat(detail.locator("table").last()).containsText("mission stop");
        farm.page().getByText("Who commanded what").first().click();
        assertThat(detail).hasCount(0);
        assertThat(farm.find("#missions-panel tbody")).containsText("again");
    }

    @Tag("full")
    @Test
    void createsAMissionOfRealDevicesThatWaitsForTheirFirstReport(PageSuite suite) {
        FarmPage farm = suite.open("#/missions").expectingError("status of 400.*recordings/own/timeline");
        farm.button("New mission").click();
        Locator dialog = farm.find("dialog[open]");
        dialog.getByLabel("Name").fill("own");
        dialog.getByLabel("Domain").selectOption("farm");
        dialog.getByLabel("Template").selectOption(" own");
        dialog.getByLabel("How many").fill("2");
        dialog.getByText("Create", EXACTLY).click();

        Locator detail = farm.find("furrow-missions .mission-detail");
        assertThat(detail.locator(".pill").first()).hasText("starting");
        assertThat(detail.locator(".device-table tbody")).containsText("Thermometer own-2");
        // A device is silent only after three of its periods, however long they are.
        String states = "import('/core/entity.js').then(({ stateOf }) => [2_700_000, 2_700_001].map((age) => "
                + "stateOf({ word: '', period: null }, age, 0, 'PT15M')).join())";
        Assertions.assertThat(farm.run(states)).isEqualTo("ok,stale");
        detail.getByText("Stop", EXACTLY).click();
        dialog.getByText("Stop", EXACTLY).click();
        assertThat(detail.locator(".pill").first()).hasText("stopped");
    }

    /** Its robots have implements, and meet. */
    @Tag("full")
    @Test
    void reportsWhatARunningMissionHasDone(PageSuite suite) {
        FarmPage farm = suite.open("#/missions?mission=weeding");
        farm.find(".mission-detail a[data-act=report]").click();
        assertThat(farm.find("furrow-report h1")).hasText("Report of weeding");
        for (String part : List.of("coverages", "encounters", "averages", "devices")) {
            farm.until(
                    () -> {
                        boolean isShown =
                                farm.find(".report-" + part + " tbody tr").count() > 0;
                        if (!isShown && farm.button("Read again").isVisible()) {
                            farm.button("Read again").click();
                        }
                        return isShown;
                    },
                    FarmPage.TIMEOUT);
        }
        assertThat(farm.find(".report-cells[data-cells=worked]").first()).isVisible();
        assertThat(farm.find("furrow-report .error-note")).hasCount(0);
    }

    @Tag("full")
    @Test
    void showsAMissionThoughNoneRuns(PageSuite suite) {
        FarmPage farm = suite.window();
        farm.page().route("**/api/missions", route -> {
            APIResponse answer = route.fetch();
            String stopped = answer.text().replace("\"running\":true", "\"running\":false");
            route.fulfill(new Route.FulfillOptions().setResponse(answer).setBody(stopped));
        });
        farm.open("#/missions");

        assertThat(farm.find("furrow-missions .mission-detail")).isVisible();
        assertThat(farm.find("furrow-missions .mission-row[aria-pressed=true]")).hasCount(1);
    }

    @Tag("full")
    @Test
    void showsDomainsAndFields(PageSuite suite) {
        FarmPage farm = suite.open("#/missions?tab=domains");

        assertThat(farm.find("#missions-panel")).containsText("Demonstration farm");
        assertThat(farm.find("#missions-panel")).containsText("River field");
        assertThat(farm.find("#missions-panel")).containsText("zone without alarms");
    }

    @Tag("full")
    @Test
    void createsAndDeletesADomain(PageSuite suite) {
        FarmPage farm = suite.open("#/missions?tab=domains");
        farm.button("New domain").click();
        Locator dialog = farm.find("dialog[open]");
        dialog.getByLabel("Name in topics").fill("orchard");
        dialog.getByLabel("Name for people").fill("The old orchard");
        dialog.getByText("Create", EXACTLY).click();
        assertThat(dialog).hasCount(0);
        Locator orchard = farm.find("#missions-panel li.card").filter(having("The old orchard"));
        assertThat(orchard).containsText("0 missions, 0 fields");

        orchard.getByLabel("Delete domain orchard").click();
        dialog.getByText("Delete", EXACTLY).click();
        assertThat(dialog).hasCount(0);
        assertThat(orchard).hasCount(0);
    }

    /** Imports the existing fields, since other tests count them. */
    @Tag("full")
    @Test
    void importsFieldsAndReportsAnInvalidFile(PageSuite suite) throws Exception {
        FarmPage farm = suite.open("#/missions?tab=domains");
        farm.button("Import fields").click();
        Locator dialog = farm.find("dialog[open]");
        Locator action = dialog.locator("button[type=submit]");

        dialog.getByLabel("File").setInputFiles(file("notes.geojson", "no JSON"));
        assertThat(dialog).containsText("The file is not a GeoJSON.");
        assertThat(action).isDisabled();

        JsonNode fields = suite.rest("/api/fields");
        dialog.getByLabel("File").setInputFiles(file("farm.geojson", fields.toString()));
        assertThat(dialog)
                .containsText("Areas in the file: " + fields.path("features").size());
        action.click();
        assertThat(dialog).containsText(Pattern.compile("Imported: \\d\\. Unchanged: \\d"));
        action.click();
        assertThat(dialog).hasCount(0);
    }

    /** Uses a field of its own and deletes it, since other tests count fields. */
    @Tag("full")
    @Test
    void renamesEndsAndDeletesAField(PageSuite suite) throws Exception {
        suite.rest("POST", "/api/fields?domain=farm", MEADOW);
        FarmPage farm = suite.open("#/missions?tab=domains");
        Locator dialog = farm.find("dialog[open]");
        Locator action = dialog.locator("button[type=submit]");
        Locator rows = farm.find(".field-table tbody tr");

        rows.getByLabel("Rename Far meadow").click();
        dialog.getByLabel("Name").fill("Behind the barn");
        action.click();
        assertThat(rows.filter(having("Behind the barn"))).containsText("meadow");

        rows.getByLabel("End Behind the barn").click();
        assertThat(dialog).containsText("a replay of an earlier time uses the field as it was");
        action.click();
        assertThat(rows.getByLabel("End Behind the barn")).hasCount(0);

        suite.rest("POST", "/api/fields?domain=farm", MEADOW);
        rows.getByLabel("Delete Far meadow").click();
        assertThat(dialog).containsText("All its versions are deleted");
        action.click();
        assertThat(dialog).hasCount(0);
        assertThat(rows.getByLabel("Delete Far meadow")).hasCount(0);
    }

    @Tag("full")
    @Test
    void importsADroppedFile(PageSuite suite) {
        FarmPage farm = suite.open("#/missions?tab=domains");
        assertThat(farm.find("#missions-panel")).containsText("River field");
        farm.run("""
                (content) => {
                  const dataTransfer = new DataTransfer();
                  dataTransfer.items.add(new File([content], 'meadow.geojson'));
                  const panel = document.querySelector('.domain-columns');
                  ['dragover', 'drop'].forEach((name) => panel.dispatchEvent(new DragEvent(name, { dataTransfer, bubbles: true, cancelable: true })));
                }""", MEADOW);

        assertThat(farm.find("dialog[open]")).containsText("Areas in the file: 1");
        assertThat(farm.find("dialog[open] button[type=submit]")).isEnabled();
    }

    private static FilePayload file(String name, String content) {
        return new FilePayload(name, "application/geo+json", content.getBytes(UTF_8));
    }

    @Tag("full")
    @Test
    void showsOlderCommandsOnRequestAndNewerOnesAboveThem(PageSuite suite) throws Exception {
        produceAudit(suite, 0, 450);
        FarmPage farm = suite.open("#/missions?tab=audit&mission=long-ago");
        Locator rows = farm.find("furrow-missions .audit-table tbody tr");

        assertThat(rows).hasCount(200);
        assertThat(rows.first()).containsText("command-449");
        assertThat(rows.last()).containsText("command-250");
        farm.button("Show older").click();
        assertThat(rows).hasCount(400);
        farm.button("Show older").click();
        assertThat(rows).hasCount(450);
        assertThat(rows.last()).containsText("command-0");
        assertThat(farm.button("Show older")).hasCount(0);
        assertThat(farm.find("furrow-missions")).containsText("There are no older ones.");

        produceAudit(suite, 450, 451);
        assertThat(rows).hasCount(451);
        assertThat(rows.first()).containsText("command-450");
        assertThat(rows.nth(1)).containsText("command-449");
        assertThat(rows.last()).containsText("command-0");
    }

    private static void produceAudit(PageSuite suite, int from, int to) {
        try (KafkaProducer<byte[], byte[]> producer = new KafkaProducer<>(
                suite.running().suite().kafka().clientProperties(),
                new ByteArraySerializer(),
                new ByteArraySerializer())) {
            for (int i = from; i < to; i++) {
                String entry = """
                        {"time":%d,"user":"olga","target":"device","command":"command-%d","about":{"mission":"long-ago"},"result":"sent"}""".formatted(1_700_000_000_000L + i, i);
                producer.send(new ProducerRecord<>(Topics.AUDIT, entry.getBytes(UTF_8)));
            }
        }
    }
}
