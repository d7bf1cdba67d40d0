package io.furrow.suite.page;

import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.SortedMap;
import java.util.TreeMap;
import javax.imageio.ImageIO;

import io.furrow.files.Gzip;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static java.nio.charset.StandardCharsets.UTF_8;

/** Writes a PMTiles file of version 3: images of a single color each, compressed directories on two levels. */
final class TileArchive {
    private static final int HEADER = 127;
    private static final int GZIP = 2;
    private static final int NONE = 1;
    private static final int PNG = 2;
    private static final int SIDE = 256;

    /** Colors by tile id; consecutive tiles with the same color become one entry. */
    private final SortedMap<Long, Integer> colors = new TreeMap<>();

    private final ByteArrayOutputStream tiles = new ByteArrayOutputStream();

    private record Entry(long id, long run, byte[] picture, long offset) {}

    /** @param id as the specification counts: 0 is the world, 1 to 4 are the tiles of zoom 1 */
    TileArchive add(long id, int rgb) {
        colors.put(id, rgb);
        return this;
    }

    void write(Path file, int maxZoom, String attribution, int entriesOfLeaf) throws IOException {
        List<Entry> entries = entries();
        ByteArrayOutputStream leaves = new ByteArrayOutputStream();
        List<long[]> root = new ArrayList<>();
        for (int i = 0; i < entries.size(); i += entriesOfLeaf) {
            List<Entry> part = entries.subList(i, Math.min(entries.size(), i + entriesOfLeaf));
            byte[] leaf = Gzip.of(directory(part.stream()
                    .map(each -> new long[] {each.id(), each.run(), each.picture().length, each.offset()})
                    .toList()));
            root.add(new long[] {part.get(0).id(), 0, leaf.length, leaves.size()});
            leaves.writeBytes(leaf);
        }
        byte[] first = Gzip.of(directory(root));
        byte[] metadata = Gzip.of(("{\"attribution\":\"" + attribution + "\"}").getBytes(UTF_8));
        ByteBuffer header = ByteBuffer.allocate(HEADER).order(ByteOrder.LITTLE_ENDIAN);
        long at = HEADER;
        header.put("PMTiles".getBytes(US_ASCII)).put((byte) 3);
        for (int length : new int[] {first.length, metadata.length, leaves.size(), tiles.size()}) {
            header.putLong(at).putLong(length);
            at += length;
        }
        header.putLong(colors.size()).putLong(entries.size()).putLong(entries.size());
        header.put((byte) 1)
                .put((byte) GZIP)
                .put((byte) NONE)
                .put((byte) PNG)
                .put((byte) 0)
                .put((byte) maxZoom);
        ByteArrayOutputStream all = new ByteArrayOutputStream();
        all.writeBytes(header.array());
        all.writeBytes(first);
        all.writeBytes(metadata);
        all.writeBytes(leaves.toByteArray());
        all.writeBytes(tiles.toByteArray());
        Files.write(file, all.toByteArray());
    }

    private List<Entry> entries() throws IOException {
        List<Entry> entries = new ArrayList<>();
        long last = -2;
        int previousColor = -1;
        for (var each : colors.entrySet()) {
            if (each.getKey() == last + 1 && each.getValue() == previousColor) {
                Entry previous = entries.remove(entries.size() - 1);
                entries.add(new Entry(previous.id(), previous.run() + 1, previous.picture(), previous.offset()));
            } else {
                byte[] picture = picture(each.getValue());
                entries.add(new Entry(each.getKey(), 1, picture, tiles.size()));
                tiles.writeBytes(picture);
            }
            last = each.getKey();
            previousColor = each.getValue();
        }
        return entries;
    }

    static byte[] picture(int rgb) throws IOException {
        BufferedImage image = new BufferedImage(SIDE, SIDE, BufferedImage.TYPE_INT_RGB);
        Graphics2D graphics = image.createGraphics();
        graphics.setColor(new Color(rgb));
        graphics.fillRect(0, 0, SIDE, SIDE);
        graphics.dispose();
        ByteArrayOutputStream png = new ByteArrayOutputStream();
        ImageIO.write(image, "png", png);
        return png.toByteArray();
    }

    /** @param entries id, run, length and offset of each */
    private static byte[] directory(List<long[]> entries) {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        varint(out, entries.size());
        long last = 0;
        for (long[] each : entries) {
            varint(out, each[0] - last);
            last = each[0];
        }
        entries.forEach(each -> varint(out, each[1]));
        entries.forEach(each -> varint(out, each[2]));
        for (int i = 0; i < entries.size(); i++) {
            long[] previous = i == 0 ? null : entries.get(i - 1);
            boolean follows = previous != null && previous[2] + previous[3] == entries.get(i)[3];
            varint(out, follows ? 0 : entries.get(i)[3] + 1);
        }
        return out.toByteArray();
    }

    private static void varint(ByteArrayOutputStream out, long value) {
        long rest = value;
        for (; rest > 127; rest >>>= 7) {
            out.write((int) (rest & 127 | 128));
        }
        out.write((int) rest);
    }
}
