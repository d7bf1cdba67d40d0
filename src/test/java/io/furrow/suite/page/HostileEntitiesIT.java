package io.furrow.suite.page;

import java.time.Instant;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.options.AriaRole;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.ATTRIBUTES;
import static io.furrow.suite.page.FarmPage.having;
import static java.nio.charset.StandardCharsets.UTF_8;

/** Hostile records: the page shows them as text or truncates them, never runs them, and keeps working. */
@PageTest
@Tag("full")
class HostileEntitiesIT {
    private static final String SCRIPT = "<img src=x onerror='window.ran = true'><script>window.ran = true</script>";

    @Test
    void showsHtmlAsText(PageSuite suite) throws Exception {
        String id = "urn:ngsi-ld:Thermometer:<b>" + SCRIPT;
        ObjectNode entity = entity(id, "<i>Thermometer" + SCRIPT);
        attribute(entity, "Temperature", 21.5);
        attribute(entity, SCRIPT, SCRIPT);
        attribute(entity, "name", "Malice " + SCRIPT);
        attribute(entity, "Domain", SCRIPT);
        attribute(entity, "status", SCRIPT);
        suite.produce("data.raw", id, NgsiJson.write(entity));

        FarmPage farm = suite.open("");
        Locator card = farm.find("furrow-cards li.card").filter(having("Malice"));
        assertThat(card.locator("h3")).containsText("<img src=x onerror");
        card.getByRole(AriaRole.BUTTON, ATTRIBUTES).click();
        assertThat(card.locator(".attributes")).containsText("<script>window.ran = true</script>");
        farm.button("The map as a table").click();
        assertThat(farm.find(".map-table")).containsText("Malice <img");
        farm.go("Topics");
        farm.find("[id='topic-data.raw']").check();
        farm.go("Map");
        assertAlive(farm);
        suite.forget(id);
    }

    @Test
    void omitsMostOfTenThousandAttributes(PageSuite suite) throws Exception {
        String id = "urn:ngsi-ld:Thermometer:wide";
        ObjectNode entity = entity(id, "Thermometer");
        for (int number = 0; number < 10_000; number++) {
            attribute(entity, "a" + number, number);
        }
        suite.produce("data.raw", id, NgsiJson.write(entity));

        FarmPage farm = suite.open("");
        Locator card = farm.card(id);
        card.getByRole(AriaRole.BUTTON, ATTRIBUTES).click();
        assertThat(card).containsText("more attributes are not shown");
        assertAlive(farm);
        suite.forget(id);
    }

    @Test
    void showsThatAValueIsTooLarge(PageSuite suite) throws Exception {
        String id = "urn:ngsi-ld:Thermometer:long";
        ObjectNode entity = entity(id, "Thermometer");
        attribute(entity, "Note", "x".repeat(5_000_000));
        suite.produce("data.raw", id, NgsiJson.write(entity));

        FarmPage farm = suite.open("");
        assertThat(farm.card(id)).containsText("Too large to show");
        assertAlive(farm);
        suite.forget(id);
    }

    @Test
    void drawsNoInvalidPositions(PageSuite suite) throws Exception {
        String[] positions = {"1e308, 1e308", "9000, 91", "\"NaN\", \"<b>\"", "null, {}"};
        for (int number = 0; number < positions.length; number++) {
            String id = "urn:ngsi-ld:Thermometer:outside" + number;
            String[] position = positions[number].split(", ");
            suite.produce("data.raw", id, """
                    {"id": "%s", "type": "Thermometer", "Time": {"type": "Integer", "value": %d}, "Temperature": {"type": "Float", "value": 1e308},
                     "Longitude": {"type": "Float", "value": %s}, "Latitude": {"type": "Float", "value": %s}}""".formatted(id, Instant.now().toEpochMilli(), position[0], position[1])
                    .getBytes(UTF_8));
        }

        FarmPage farm = suite.open("");
        for (int number = 0; number < positions.length; number++) {
            assertThat(farm.card("urn:ngsi-ld:Thermometer:outside" + number)).containsText("no position");
        }
        assertAlive(farm);
        for (int number = 0; number < positions.length; number++) {
            suite.forget("urn:ngsi-ld:Thermometer:outside" + number);
        }
    }

    @Test
    void worksAfterRecordsThatAreNoEntities(PageSuite suite) throws Exception {
        for (String value : new String[] {
            "no JSON", "[]", "5",
            "\"text\"", "{}", "{\"id\": 5}",
            "{\"id\": {\"a\": 1}, \"type\": []}", "{\"id\": \"__proto__\", \"type\": \"constructor\"}"
        }) {
            suite.produce("data.raw", "odd", value.getBytes(UTF_8));
        }

        FarmPage farm = suite.open("");
        for (String value : new String[] {"no JSON", "[]", "5", "{}"}) {
            suite.produce("data.raw", "odd", value.getBytes(UTF_8));
        }
        assertAlive(farm);
        suite.forget("odd");
        suite.forget("__proto__");
    }

    /** Asserts that later records of others are shown, and that no script of a record has run. */
    private static void assertAlive(FarmPage farm) {
        long now = System.currentTimeMillis();
        farm.untilStore("store.entities.get('urn:ngsi-ld:Robot:1')?.time > " + now);
        assertThat(farm.card("urn:ngsi-ld:Robot:1")).containsText("m/s");
        Assertions.assertThat(farm.run("window.ran")).isNull();
        Assertions.assertThat(farm.find("img[src=x], [onerror]").count()).isZero();
    }

    private static ObjectNode entity(String id, String type) {
        ObjectNode entity = JsonNodeFactory.instance.objectNode().put("id", id).put("type", type);
        attribute(entity, "Time", Instant.now().toEpochMilli());
        attribute(entity, "Latitude", 40.3124);
        attribute(entity, "Longitude", -3.4830);
        return entity;
    }

    private static void attribute(ObjectNode entity, String name, Object value) {
        entity.putObject(name)
                .put("type", value instanceof Number ? "Float" : "Text")
                .putPOJO("value", value);
    }
}
