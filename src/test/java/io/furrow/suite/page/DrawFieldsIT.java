package io.furrow.suite.page;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;

import com.google.gson.JsonObject;
import com.google.gson.JsonParser;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Mouse;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** Fields that are drawn and changed on the map: each change is a request that writes a version. */
@Tag("full")
class DrawFieldsIT extends StubbedPage {
    private static final double LONGITUDE = -3.4822;
    private static final double LATITUDE = 40.3125;

    @BeforeEach
    void start() {
        farm.answers("/api/domains", "[{\"domain\": \"farm\"}]").hasField("south", "farm", LONGITUDE, LATITUDE);
    }

    private FarmPage open() {
        FarmPage page = farm.open("", 1440, 900);
        page.untilStore("store.fields.size === 1 && store.domains.size === 1");
        page.button("Draw and change fields").click();
        return page;
    }

    /** Clicks corners, given as shares of the map's width and height. */
    private static void click(FarmPage page, double... shares) {
        for (int index = 0; index < shares.length; index += 2) {
            double[] at = at(page, shares[index], shares[index + 1]);
            page.page().mouse().move(at[0], at[1], new Mouse.MoveOptions().setSteps(2));
            page.page().mouse().click(at[0], at[1]);
        }
    }

    private static double[] at(FarmPage page, double x, double y) {
        List<?> box = (List<?>)
                page.run(
                        "() => { const box = document.querySelector('.map-target').getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; }");
        double[] of =
                box.stream().mapToDouble(each -> ((Number) each).doubleValue()).toArray();
        return new double[] {of[0] + x * of[2], of[1] + y * of[3]};
    }

    /** The pixel of a place on the map. */
    private static double[] spot(FarmPage page, double longitude, double latitude) {
        List<?> pixel = (List<?>) page.run(
                "async (place) => { const { project } = await import('/map/projection.js'); const { map, target } = document.querySelector('furrow-map');"
                        + " const box = target.getBoundingClientRect(); const [x, y] = map.getPixelFromCoordinate(project(...place)); return [x + box.left, y + box.top]; }",
                List.of(longitude, latitude));
        return pixel.stream().mapToDouble(each -> ((Number) each).doubleValue()).toArray();
    }

    private static void drag(FarmPage page, double[] from, double[] to) {
        page.page().mouse().move(from[0], from[1]);
        page.page().mouse().down();
        page.page().mouse().move(to[0], to[1], new Mouse.MoveOptions().setSteps(4));
        page.page().mouse().up();
    }

    private List<String> posts() {
        return farm.sent().stream()
                .filter(each -> each.startsWith("POST /api/fields "))
                .toList();
    }

    /** The feature of a request, once it is sent; the page receives it as a version. */
    private JsonObject written(FarmPage page, int number) {
        page.until(() -> posts().size() == number);
        JsonObject feature = JsonParser.parseString(posts().get(number - 1).substring("POST /api/fields ".length()))
                .getAsJsonObject();
        farm.send(
                "service.fields",
                feature.get("id").getAsString() + "@" + Instant.now(),
                feature.toString().replace("'", "\\'"));
        return feature;
    }

    @Test
    void drawsAFieldWithItsAttributesAndUndoesIt() {
        FarmPage page = open();
        page.button("New field").click();
        click(page, 0.1, 0.1, 0.3, 0.1, 0.3, 0.3);
        page.button("Finish").click();
        Locator dialog = page.find("dialog[open]");
        dialog.getByLabel("Name").fill("Behind the barn");
        assertThat(dialog.getByLabel("Domain")).hasValue("farm");
        dialog.getByLabel("Crop").fill("maize");
        dialog.getByText("Along the longest side").click();
        dialog.locator("button[type=submit]").click();

        JsonObject feature = written(page, 1);
        JsonObject properties = feature.getAsJsonObject("properties");
        assertThat(feature.get("id").getAsString()).isEqualTo("behind-the-barn");
        assertThat(properties.get("name").getAsString()).isEqualTo("Behind the barn");
        assertThat(properties.get("Domain").getAsString()).isEqualTo("farm");
        assertThat(properties.get("crop").getAsString()).isEqualTo("maize");
        assertThat(properties.get("rowDirection").getAsInt()).isBetween(0, 179);
        assertThat(feature.getAsJsonObject("geometry")
                        .getAsJsonArray("coordinates")
                        .get(0)
                        .getAsJsonArray())
                .hasSize(4);
        assertThat(page.find(".map-edit-hint")).hasText("Behind the barn is saved.");
        page.untilStore("store.fields.size === 2");

        page.button("Undo: Behind the barn was drawn").click();
        page.until(() -> farm.sent().stream()
                .anyMatch(each -> each.startsWith("PATCH /api/fields/behind-the-barn {\"validTo\":")));
        farm.send("service.fields", "behind-the-barn@" + Instant.now(), "{\"properties\": {}, \"geometry\": null}");
        assertThat(page.find(".map-edit-hint")).hasText("Undone: Behind the barn was drawn.");
        assertThat(page.button("Undo: Behind the barn was drawn")).hasCount(0);
    }

    @Test
    void movesACornerAndTheWholeAndWritesTheVersionBeforeAgain() {
        FarmPage page = open();
        double[] corner = spot(page, LONGITUDE, LATITUDE);
        double[] inside = spot(page, LONGITUDE + 0.0007, LATITUDE + 0.0003);
        page.page().mouse().click(inside[0], inside[1]);
        assertThat(page.button("Save")).isDisabled();
        drag(page, corner, new double[] {corner[0] - 40, corner[1] + 20});
        page.button("Save").click();

        JsonObject moved = written(page, 1);
        assertThat(moved.get("id").getAsString()).isEqualTo("south");
        assertThat(moved.getAsJsonObject("properties").get("name").getAsString())
                .isEqualTo("south");
        assertThat(moved.toString()).doesNotContain("[" + LONGITUDE + "," + LATITUDE + "]");
        assertThat(page.find(".map-edit-hint")).hasText("south is saved.");

        page.page().mouse().click(inside[0], inside[1]);
        drag(page, inside, new double[] {inside[0] + 30, inside[1]});
        page.button("Save").click();
        written(page, 2);
        assertThat(page.find(".map-edit-hint")).hasText("south is saved.");

        page.button("Undo: south was moved").click();
        assertThat(written(page, 3).get("geometry")).isEqualTo(moved.get("geometry"));
        page.button("Undo: south was moved").click();
        assertThat(written(page, 4).toString()).contains("[" + LONGITUDE + "," + LATITUDE + "]");
        assertThat(page.button("Undo: south was moved")).hasCount(0);
    }

    @Test
    void refusesABorderThatCrossesItself() {
        FarmPage page = open();
        page.button("New field").click();
        click(page, 0.1, 0.1, 0.3, 0.3, 0.3, 0.1, 0.1, 0.3);
        page.button("Finish").click();

        assertThat(page.find(".map-edit-hint"))
                .hasText(
                        Pattern.compile(
                                "The border crosses itself at 40\\.3\\d+, -3\\.48\\d+\\. Move a corner so that it does not\\."));
        assertThat(page.find("dialog[open]")).hasCount(0);
        assertThat(page.button("Save")).isDisabled();
        page.page().keyboard().press("Escape"); // would lose the outline
        page.button("Cancel").click();
        page.page().keyboard().press("Escape");
        assertThat(page.find(".map-edit")).isHidden();
        assertThat(farm.sent()).isEmpty();
    }

    /** By the keyboard alone. */
    @Test
    void readsTypedCornersOfAZone() {
        FarmPage page = open();
        page.button("Type corners").press("Enter");
        Locator dialog = page.find("dialog[open]");
        dialog.getByLabel("Name").fill("Yard");
        dialog.getByLabel("Kind").selectOption("exclusion");
        Locator corners = dialog.getByLabel("Latitude and longitude of each corner");
        corners.fill("40.3121, -3.4821\n40.3122, -3.4820\nnorth");
        dialog.getByLabel("Name").press("Enter");
        assertThat(dialog.getByRole(com.microsoft.playwright.options.AriaRole.ALERT))
                .containsText("Line 3 is no corner");
        corners.fill("40.3121, -3.4821\n40.3122, -3.4820\n40.3121, -3.4820");
        dialog.getByLabel("Name").press("Enter");

        JsonObject zone = written(page, 1);
        assertThat(zone.getAsJsonObject("properties").get("kind").getAsString()).isEqualTo("exclusion");
        assertThat(zone.getAsJsonObject("geometry").toString())
                .contains("[[-3.4821,40.3121],[-3.482,40.3122],[-3.482,40.3121],[-3.4821,40.3121]]");
        page.untilStore("store.fields.get('yard')?.exclusion === true");
    }

    @Test
    void endsAFieldAndWritesItAgain() {
        FarmPage page = open();
        page.page().getByLabel("Change a field …").selectOption("south");
        page.button("End").click();
        page.find("dialog[open] .button.danger").click();
        page.until(
                () -> farm.sent().stream().anyMatch(each -> each.startsWith("PATCH /api/fields/south {\"validTo\":")));
        farm.send("service.fields", "south@" + Instant.now(), "{\"properties\": {}, \"geometry\": null}");
        page.untilStore("store.fields.size === 0");

        page.button("Undo: south was ended").click();
        assertThat(written(page, 1).get("id").getAsString()).isEqualTo("south");
        page.untilStore("store.fields.size === 1");
    }

    @Test
    void asksBeforeTheChangeOfSomebodyElseIsUndone() {
        FarmPage page = open();
        page.page().getByLabel("Change a field …").selectOption("south");
        page.button("Attributes and corners").click();
        page.find("dialog[open]").getByLabel("Crop").fill("rye");
        page.find("dialog[open] button[type=submit]").click();
        JsonObject changed = written(page, 1);
        assertThat(changed.getAsJsonObject("properties").get("crop").getAsString())
                .isEqualTo("rye");
        assertThat(page.find(".map-edit-hint")).hasText("south is saved.");

        page.page().getByLabel("Change a field …").selectOption("south");
        page.button("Attributes and corners").click();
        farm.send("service.fields", "south@" + Instant.now(), changed.toString().replace("rye", "oats"));
        page.untilStore("store.fields.get('south').properties.crop === 'oats'");
        page.find("dialog[open] button[type=submit]").click();
        assertThat(page.find("dialog[open]")).containsText("Somebody changed south meanwhile.");
        page.page().keyboard().press("Escape");
        page.button("Cancel").click();
        page.button("Undo: south was changed").click();

        assertThat(page.find("dialog[open]")).containsText("The field was changed again since");
        assertThat(posts()).hasSize(1);
    }

    @Test
    void undoesWhatWasDoneInTheTable() {
        FarmPage page = farm.open("#/missions?tab=domains", 1440, 900);
        List<String> asked = new ArrayList<>();
        page.page().onRequest(request -> asked.add(request.method() + " " + request.url()));
        page.button("Rename south").click();
        page.find("dialog[open]").getByLabel("Name").fill("North");
        page.find("dialog[open] button[type=submit]").click();
        page.button("Undo: south was renamed").click();
        page.until(() -> farm.sent()
                .equals(List.of(
                        "PATCH /api/fields/south {\"name\":\"North\"}",
                        "PATCH /api/fields/south {\"name\":\"south\"}")));

        page.button("Delete south").click();
        page.find("dialog[open] button[type=submit]").click();
        page.until(() -> farm.sent().stream().anyMatch(each -> each.startsWith("DELETE /api/fields/south")));
        farm.send("service.fields", "south@2020-01-01T00:00:00Z", "null");
        assertThat(page.button("Delete south")).hasCount(0);
        page.button("Undo: south was deleted").click();
        JsonObject written = written(page, 1);
        assertThat(written.get("id").getAsString()).isEqualTo("south");
        assertThat(written.toString()).contains("[" + LONGITUDE + "," + LATITUDE + "]");
        page.until(() -> asked.stream()
                .anyMatch(each -> each.startsWith("POST ")
                        && each.endsWith("/api/fields?validFrom="
                                + Instant.parse("2020-01-01T00:00:00Z").toEpochMilli())));
        assertThat(page.button("Undo: south was deleted")).hasCount(0);
        assertThat(page.find("[role=status]").filter(FarmPage.having("Undone: south was deleted.")))
                .isVisible();
    }

    @Test
    void isOnlyForOperatorsAndLive() {
        farm.answers("/api/me", "{\"user\": \"eva\", \"role\": \"viewer\"}");
        FarmPage page = farm.open("", 1440, 900);
        page.untilStore("store.fields.size === 1");
        assertThat(page.button("The map as a table")).isVisible();
        assertThat(page.button("Draw and change fields")).isHidden();

        page.store("(store.me = { user: 'olga', role: 'operator' }, store.notify('me'))");
        assertThat(page.button("Draw and change fields")).isVisible();
    }
}
