package io.furrow.dashboard.page;

import java.nio.file.Path;
import java.util.List;

/**
 * Files and settings of the page.
 *
 * @param folder with the files of the page, for those who work on them; null for those of this build
 * @param tiles URL of map tiles below the fields, with {@code {z}}, {@code {x}} and {@code {y}}; null for none
 * @param tileFile PMTiles file of map tiles instead; null for none
 * @param images folders of which stored images are served
 */
public record PageSettings(Path folder, String tiles, Path tileFile, List<Path> images) {
    /** The page of this build without tiles and images. */
    public static final PageSettings DEFAULT = new PageSettings(null, null, null, List.of());

    public PageSettings {
        images = List.copyOf(images);
    }
}
