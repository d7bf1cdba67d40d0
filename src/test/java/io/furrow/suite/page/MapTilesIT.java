package io.furrow.suite.page;

import java.nio.file.Path;
import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.dashboard.Dashboard;
import io.furrow.dashboard.DashboardSettings;
import io.furrow.dashboard.page.PageSettings;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** Map tiles from a PMTiles file. */
@PageTest
@Tag("full")
class MapTilesIT {
    private static final int NOWHERE = 0x2040FF;
    private static final int FARM = 0xC01080;
    private static final int SEA = 0x10C0C0;
    /**
     * The tile of zoom 2 with the farm near Madrid, column 1 and row 1: 5 tiles precede its zoom, and it is the third
     * on the curve.
     */
    private static final long FARM_ID = 7;

    @TempDir
    Path directory;

    private Path file() throws Exception {
        Path file = directory.resolve("base.pmtiles");
        TileArchive archive = new TileArchive().add(0, NOWHERE);
        for (long id = 1; id <= 4; id++) {
            archive.add(id, SEA);
        }
        archive.add(5, NOWHERE).add(FARM_ID, FARM).add(9, NOWHERE).add(10, NOWHERE);
        archive.write(file, 2, "© <a href='https://example.org'>Somebody's</a> pictures", 2);
        return file;
    }

    private Dashboard dashboard(PageSuite suite, Path file) throws Exception {
        return Dashboard.start(DashboardSettings.of(
                        0,
                        suite.running().suite().kafka().clientProperties(),
                        suite.running().suite().control())
                .withPage(new PageSettings(null, null, file, List.of())));
    }

    @Test
    void drawsThemBelowTheFieldsAndNamesTheirSource(PageSuite suite) throws Exception {
        try (Dashboard dashboard = dashboard(suite, file())) {
            FarmPage farm = suite.open(dashboard.uri(), "", WindowStyle.DESKTOP)
                    .expectingError("404.*/api/images/"); // has no folder of images

            farm.untilStore("store.fields.size === 4");
            farm.until(() -> share(farm, FARM) > 0.95, FarmPage.TIMEOUT);
            assertThat(farm.find(".map-attribution")).hasText("© Somebody's pictures");
            assertThat(farm.find(".map-attribution a")).hasCount(0);

            farm.run(
                    "() => { const map = document.querySelector('furrow-map'); map.moved = true; map.view.setZoom(2); }");
            farm.until(() -> share(farm, NOWHERE) > 0.05 && share(farm, FARM) < 0.5, FarmPage.TIMEOUT);
            farm.close();
        }
    }

    /** The share of the map with this color, before the style sheet mutes it. */
    static double share(FarmPage farm, int rgb) {
        Object share = farm.run("""
                        (rgb) => {
                          const canvas = document.querySelector('furrow-map .map-tiles canvas');
                          if (!canvas?.width) { return 0; }
                          const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
                          let count = 0;
                          for (let i = 0; i < data.length; i += 4) {
                            count += (data[i] << 16 | data[i + 1] << 8 | data[i + 2]) === rgb;
                          }
                          return count * 4 / data.length;
                        }""", rgb);
        return ((Number) share).doubleValue();
    }

    @Test
    void findsTilesByTheirIdAndReportsMissingOnes(PageSuite suite) throws Exception {
        try (Dashboard dashboard = dashboard(suite, file())) {
            FarmPage farm = suite.open(dashboard.uri(), "", WindowStyle.DESKTOP)
                    .expectingError("404.*/api/images/"); // has no folder of images

            assertThat(tile(farm, 0, 0, 0)).isEqualTo(TileArchive.picture(NOWHERE).length);
            for (int x = 0; x < 2; x++) {
                for (int y = 0; y < 2; y++) {
                    assertThat(tile(farm, 1, x, y)).isEqualTo(TileArchive.picture(SEA).length);
                }
            }
            assertThat(color(farm, 2, 0, 0)).isEqualTo(NOWHERE);
            assertThat(color(farm, 2, 1, 1)).isEqualTo(FARM);
            assertThat(color(farm, 1, 1, 0)).isEqualTo(SEA);
            assertThat(tile(farm, 2, 1, 0)).isZero();
            assertThat(tile(farm, 2, 3, 3)).isZero();
            assertThat(tile(farm, 3, 0, 0)).isZero();
            // from the specification and its reference implementation
            Map<List<Integer>, Long> ids = Map.of(
                    List.of(0, 0, 0), 0L,
                    List.of(1, 0, 0), 1L,
                    List.of(1, 0, 1), 2L,
                    List.of(1, 1, 1), 3L,
                    List.of(1, 1, 0), 4L,
                    List.of(2, 0, 0), 5L,
                    List.of(12, 3423, 1763), 19_078_479L);
            ids.forEach(
                    (position, id) -> assertThat(((Number) evaluate(farm, "tileId(...argument)", position)).longValue())
                            .as("%s", position)
                            .isEqualTo(id));
            farm.close();
        }
    }

    private static Object evaluate(FarmPage farm, String expression, Object argument) {
        return farm.run(
                "async (argument) => { const { PmtilesFile, tileId } = await import('/map/pmtiles.js'); return "
                        + expression + "; }",
                argument);
    }

    /** Bytes of a tile; 0 if there is none. */
    private static int tile(FarmPage farm, int z, int x, int y) {
        return ((Number) evaluate(
                        farm,
                        "(await new PmtilesFile('/tiles/base.pmtiles').tile(...argument))?.size ?? 0",
                        List.of(z, x, y)))
                .intValue();
    }

    private static int color(FarmPage farm, int z, int x, int y) {
        return ((Number) evaluate(farm, """
                        await (async () => {
                          const image = await createImageBitmap(await new PmtilesFile('/tiles/base.pmtiles').tile(...argument));
                          const context = new OffscreenCanvas(1, 1).getContext('2d');
                          context.drawImage(image, 0, 0);
                          const [red, green, blue] = context.getImageData(0, 0, 1, 1).data;
                          return red << 16 | green << 8 | blue;
                        })()""", List.of(z, x, y))).intValue();
    }
}
