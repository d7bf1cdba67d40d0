package io.furrow.simulators.camera;

import java.awt.Rectangle;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.time.ZoneOffset;
import java.time.format.DateTimeFormatter;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import javax.imageio.ImageIO;
import javax.imageio.stream.MemoryCacheImageOutputStream;

import io.furrow.model.ngsi.Position;

/**
 * Draws what a camera sees: sky, a sun that crosses it once a minute, crop rows, what is in sight, and a caption. Set pixel by pixel: neither
 * fonts nor a display are needed, which a bare JDK may lack.
 */
public final class FieldPicture {
    static final int WIDTH = 320;
    static final int HEIGHT = 200;

    private static final int HORIZON = 75;
    private static final int SKY = 0x9CC9E8;
    private static final int SUN = 0xF7C948;
    private static final int SOIL = 0x7A5A3A;
    private static final int CROP = 0x3E8E41;
    private static final int CAPTION = 0x1B1B1B;
    private static final int LETTERS = 0xFFFFFF;
    private static final int HULL = 0xC0392B;
    static final int LEFT = 2;
    static final int LINE = 13;
    static final int CAPTION_TOP = HEIGHT - 42;
    private static final int ROW_METERS = 24;
    private static final DateTimeFormatter SECOND =
            DateTimeFormatter.ofPattern("yyyy-MM-dd HH:mm:ss", Locale.ROOT).withZone(ZoneOffset.UTC);

    private FieldPicture() {}

    /** A PNG of {@value #WIDTH} × {@value #HEIGHT} pixels; the same for the same view. */
    public static byte[] png(View view) {
        BufferedImage image = new BufferedImage(WIDTH, HEIGHT, BufferedImage.TYPE_INT_RGB);
        int sun = (int) (Math.floorMod(view.time().toEpochMilli() / 1000, 60L) * WIDTH / 60);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                image.setRGB(x, y, y < HORIZON ? sky(x, y, sun) : ground(x, y));
            }
        }
        view.sightings().forEach(seen -> draw(image, seen));
        fill(image, new Rectangle(0, CAPTION_TOP, WIDTH, HEIGHT - CAPTION_TOP), CAPTION);
        caption(image, view);
        return encode(image);
    }

    /** Which camera, when and where, and what is in sight, the nearest first. */
    private static void caption(BufferedImage image, View view) {
        Position place = view.place();
        List<View.Sighting> seen = new ArrayList<>(view.sightings());
        Collections.reverse(seen);
        String what = Stream.concat(
                        Stream.of(view.where()),
                        seen.stream()
                                .map(thing -> String.format(Locale.ROOT, "%s %.0fM", thing.name(), thing.meters())))
                .filter(part -> !part.isBlank())
                .collect(Collectors.joining(" / "));
        String where = String.format(Locale.ROOT, "%.5f %.5f", place.latitude(), place.longitude());
        List<String> lines = List.of(view.camera(), SECOND.format(view.time()) + " " + where, what);
        for (int line = 0; line < lines.size(); line++) {
            PixelFont.write(
                    image, lines.get(line).toUpperCase(Locale.ROOT), LEFT, CAPTION_TOP + 3 + line * LINE, LETTERS);
        }
    }

    /** A block with two wheels, the larger the nearer. */
    private static void draw(BufferedImage image, View.Sighting seen) {
        int size = (int) Math.min(60, Math.max(6, 300 / seen.meters()));
        int middle = (int) (WIDTH / 2d * (1 + seen.aside()));
        int ground = HORIZON + size;
        int left = middle - size / 2;
        int wheel = Math.max(1, size / 4);
        fill(image, new Rectangle(left, ground - size, size, size), HULL);
        fill(image, new Rectangle(left, ground - wheel, wheel, wheel), CAPTION);
        fill(image, new Rectangle(left + size - wheel, ground - wheel, wheel, wheel), CAPTION);
    }

    private static void fill(BufferedImage image, Rectangle area, int rgb) {
        Rectangle part = area.intersection(new Rectangle(WIDTH, HEIGHT));
        for (int y = part.y; y < part.y + part.height; y++) {
            for (int x = part.x; x < part.x + part.width; x++) {
                image.setRGB(x, y, rgb);
            }
        }
    }

    private static int sky(int x, int y, int sun) {
        return Math.hypot(x - sun, y - 20) < 9 ? SUN : SKY;
    }

    /** Rows meet at a point on the horizon. */
    private static int ground(int x, int y) {
        double depth = (y - HORIZON + 4) / 80d;
        double across = (x - WIDTH / 2d) / depth;
        return Math.floorMod((int) Math.floor(across / ROW_METERS), 2) == 0 ? SOIL : CROP;
    }

    private static byte[] encode(BufferedImage image) {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream(4096);
        // The memory cache, because ImageIO otherwise makes a temporary file for each picture.
        try (MemoryCacheImageOutputStream out = new MemoryCacheImageOutputStream(bytes)) {
            if (!ImageIO.write(image, "png", out)) {
                throw new IllegalStateException("this JDK cannot write PNG: it needs the module java.desktop");
            }
        } catch (IOException e) {
            throw new UncheckedIOException("a picture could not be written to memory", e);
        }
        return bytes.toByteArray();
    }
}
