package io.furrow.simulators.camera;

import java.awt.Rectangle;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import javax.imageio.ImageIO;
import javax.imageio.stream.MemoryCacheImageOutputStream;

/**
 * Draws the view of a camera: sky, a sun that crosses it once a minute, crop rows and robots in sight. Set pixel by pixel, because
 * a bare JDK may lack fonts and a display.
 */
public final class FieldPicture {
    static final int WIDTH = 320;
    static final int HEIGHT = 200;

    private static final int HORIZON = 75;
    private static final int SKY = 0x9CC9E8;
    private static final int SUN = 0xF7C948;
    private static final int SOIL = 0x7A5A3A;
    private static final int CROP = 0x3E8E41;
    private static final int WHEEL = 0x1B1B1B;
    private static final int HULL = 0xC0392B;
    private static final int ROW_METERS = 24;

    private FieldPicture() {}

    /** A PNG of {@value #WIDTH} × {@value #HEIGHT} pixels; the same for the same view. */
    public static byte[] png(CameraView view) {
        BufferedImage image = new BufferedImage(WIDTH, HEIGHT, BufferedImage.TYPE_INT_RGB);
        int sun = (int) (Math.floorMod(view.time().toEpochMilli() / 1000, 60L) * WIDTH / 60);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                image.setRGB(x, y, y < HORIZON ? sky(x, y, sun) : ground(x, y));
            }
        }
        view.visibleRobots().forEach(seen -> draw(image, seen));
        return encode(image);
    }

    /** A block with two wheels, larger if nearer. */
    private static void draw(BufferedImage image, CameraView.VisibleRobot seen) {
        int size = (int) Math.min(60, Math.max(6, 300 / seen.meters()));
        int middle = (int) (WIDTH / 2d * (1 + seen.aside()));
        int ground = HORIZON + size;
        int left = middle - size / 2;
        int wheel = Math.max(1, size / 4);
        fill(image, new Rectangle(left, ground - size, size, size), HULL);
        fill(image, new Rectangle(left, ground - wheel, wheel, wheel), WHEEL);
        fill(image, new Rectangle(left + size - wheel, ground - wheel, wheel, wheel), WHEEL);
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
