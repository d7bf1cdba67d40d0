package io.furrow.suite.page;

import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The base map that is chosen in the page: of the server, or a file of the user. */
@Tag("full")
class BaseMapIT extends StubbedPage {
    private static final int GROUND = 0xC01080;

    @TempDir
    Path directory;

    @BeforeEach
    void start() {
        farm.hasField("south", "farm", -3.4822, 40.3125);
    }

    private FarmPage open() {
        FarmPage page = farm.open("", 1440, 900);
        page.untilStore("store.fields.size === 1");
        return page;
    }

    private static Locator menu(FarmPage page) {
        page.button("What is shown").click();
        assertThat(page.find(".base-map")).isVisible();
        return page.find(".base-map");
    }

    /** Neither the server nor another one is asked for it. */
    @Test
    void drawsAFileOfTheUserAlsoAfterAReload() throws Exception {
        Path file = directory.resolve("meadow.pmtiles");
        new TileArchive().add(0, GROUND).write(file, 0, "© Somebody", 2);
        FarmPage page = open();
        Locator menu = menu(page);
        assertThat(menu.locator("label")).hasText(new String[] {"none"});
        menu.locator("input[type=file]").setInputFiles(file);
        page.until(() -> MapTilesIT.share(page, GROUND) > 0.95);
        assertThat(page.find(".map-attribution")).hasText("© Somebody");

        page.page().reload();
        page.until(() -> MapTilesIT.share(page, GROUND) > 0.95);
        menu(page).getByLabel("Remove meadow.pmtiles from this browser").click();
        assertThat(menu.locator("label")).hasText(new String[] {"none"});
        page.until(() -> MapTilesIT.share(page, GROUND) == 0);
        assertThat(page.find(".map-attribution")).isHidden();
    }

    @Test
    void refusesAFileThatHasNoPictures() throws Exception {
        Path file = Files.writeString(directory.resolve("field.pmtiles"), "no tiles");
        FarmPage page = open();
        Locator menu = menu(page);
        menu.locator("input[type=file]").setInputFiles(file);

        assertThat(menu.getByRole(com.microsoft.playwright.options.AriaRole.ALERT))
                .hasText("The base map cannot be shown: field.pmtiles is not a PMTiles file of version 3");
        assertThat(menu.locator("label")).hasText(new String[] {"none"});
    }

    @Test
    void remembersThatTheMapOfTheServerIsNotShown() {
        farm.configures("\"tiles\": \"/api/tiles/{z}/{x}/{y}\"");
        FarmPage page = open();
        List<String> requested = new CopyOnWriteArrayList<>();
        page.page().onRequest(request -> requested.add(URI.create(request.url()).getPath()));
        page.page().reload();
        page.until(() -> requested.stream().anyMatch(each -> each.startsWith("/api/tiles/")));
        menu(page).getByLabel("none").check();

        requested.clear();
        page.page().reload();
        page.untilStore("store.fields.size === 1");
        Locator menu = menu(page);
        assertThat(menu.getByLabel("none")).isChecked();
        assertThat(requested).isNotEmpty().noneMatch(each -> each.startsWith("/api/tiles/"));
        menu.getByLabel("of 127.0.0.1").check();
        page.until(() -> requested.stream().anyMatch(each -> each.startsWith("/api/tiles/")));
    }
}
