package io.furrow.dashboard.page;

import java.nio.file.Path;
import java.util.List;

/**
 * Files and settings of the page.
 *
 * @param folder with the files of the page, for development; null for those of this build
 * @param tiles URL of map tiles below the fields, with {@code {z}}, {@code {x}} and {@code {y}}; null for none
 * @param tileFile PMTiles file of map tiles, between which and those of the URL users choose; null for none
 * @param images folders whose stored images are served
 * @param signIn URL at which a proxy signs users in; null if each user has a token. In it and in {@code signOut},
 *     <code>{page}</code> stands for the address to return to
 * @param signOut URL at which the proxy signs them out; null for none
 */
public record PageSettings(Path folder, String tiles, Path tileFile, List<Path> images, String signIn, String signOut) {
    /** The page of this build, without tiles and images. */
    public static final PageSettings DEFAULT = new PageSettings(null, null, null, List.of());

    public PageSettings {
        images = List.copyOf(images);
    }

    public PageSettings(Path folder, String tiles, Path tileFile, List<Path> images) {
        this(folder, tiles, tileFile, images, null, null);
    }

    public PageSettings withImages(List<Path> folders) {
        return new PageSettings(folder, tiles, tileFile, folders, signIn, signOut);
    }

    public PageSettings withSignIn(String in, String out) {
        return new PageSettings(folder, tiles, tileFile, images, in, out);
    }
}
