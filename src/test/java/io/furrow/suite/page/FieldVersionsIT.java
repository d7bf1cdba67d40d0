package io.furrow.suite.page;

import com.microsoft.playwright.Locator;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** Fields of the page in `service.fields`: what the page writes is what the topic returns. */
@PageTest
@Tag("full")
class FieldVersionsIT {
    private static final String KNOWN = "(store.fields.get('page-meadow')?.properties.crop ?? 'none')";

    @Test
    void writesAVersionPerChangeAndUndoesThemInTurn(PageSuite suite) {
        FarmPage farm = suite.open("", WindowStyle.DESKTOP);
        farm.untilStore("store.fields.size >= 4");
        farm.button("Draw and change fields").click();
        farm.button("Type corners").click();
        Locator dialog = farm.find("dialog[open]");
        dialog.getByLabel("Name").fill("Page meadow");
        dialog.getByLabel("Crop").fill("clover");
        dialog.getByLabel("Latitude and longitude of each corner")
                .fill("40.3051, -3.4901\n40.3051, -3.4891\n40.3061, -3.4891");
        dialog.locator("button[type=submit]").click();
        assertThat(farm.find(".map-edit-hint")).hasText("Page meadow is saved.");
        farm.untilStore(KNOWN + " === 'clover'");

        farm.page().getByLabel("Change a field …").selectOption("page-meadow");
        farm.button("Attributes and corners").click();
        dialog.getByLabel("Crop").fill("rye");
        dialog.locator("button[type=submit]").click();
        farm.untilStore(KNOWN + " === 'rye'");
        farm.untilStore("store.fieldVersions.get('page-meadow').size === 2");

        returnsAfterItsDeletion(farm);
        farm.button("Undo: Page meadow was changed").click();
        farm.untilStore(KNOWN + " === 'clover'");
        farm.button("Undo: Page meadow was drawn").click();
        farm.untilStore("!store.fields.has('page-meadow')");
        farm.untilStore("store.fieldVersions.get('page-meadow').size === 6");
        assertThat(farm.button("Undo: Page meadow was drawn")).hasCount(0);
        farm.close();
    }

    /** With all its versions, of which one is an end. */
    private static void returnsAfterItsDeletion(FarmPage farm) {
        farm.page().getByLabel("Change a field …").selectOption("page-meadow");
        farm.button("End").click();
        farm.find("dialog[open] .button.danger").click();
        farm.button("Undo: Page meadow was ended").click();
        farm.untilStore("store.fieldVersions.get('page-meadow').size === 4 && " + KNOWN + " === 'rye'");
        String versions =
                "JSON.stringify([...store.fieldVersions.get('page-meadow') ?? []].sort(([one], [other]) => one - other))";
        Object before = farm.store(versions);

        farm.go("Missions");
        farm.page().getByText("Domains and fields").click();
        farm.button("Delete Page meadow").click();
        farm.find("dialog[open] button[type=submit]").click();
        farm.untilStore("store.fieldVersions.get('page-meadow').size === 0");
        farm.button("Undo: Page meadow was deleted").click();
        farm.untilStore("store.fieldVersions.get('page-meadow')?.size === 4");
        Assertions.assertThat(farm.store(versions)).isEqualTo(before);

        farm.go("Map");
    }
}
