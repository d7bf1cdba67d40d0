package io.furrow.dashboard.image;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.Consumer;

import jakarta.servlet.http.HttpServlet;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.UserCache;
import io.furrow.dashboard.http.Problem;
import io.furrow.model.text.Sha256;

/**
 * {@code GET /api/images/<sha256>}: a stored image that {@code data.images} names. Reads only files below the
 * configured folders, whatever a record says, and sends only content with that SHA-256.
 */
public final class ImageServlet extends HttpServlet {
    private static final long serialVersionUID = 1L;
    private static final long MAX_BYTES = 32L << 20;

    private final transient UserCache users;
    private final transient ImageIndex index;
    private final transient List<Path> folders;
    private final transient Consumer<Problem> onRejection;

    /**
     * @param folders of stored images
     * @param onRejection is notified of each rejected request
     */
    public ImageServlet(UserCache users, ImageIndex index, List<Path> folders, Consumer<Problem> onRejection) {
        this.users = users;
        this.index = index;
        this.folders = folders;
        this.onRejection = onRejection;
    }

    @Override
    protected void doGet(HttpServletRequest request, HttpServletResponse response) throws IOException {
        try {
            users.find(Credentials.of(request));
            String path = request.getPathInfo() == null ? "" : request.getPathInfo();
            ImageLocation image = find(path.substring(Math.min(1, path.length())));
            String tag = '"' + image.sha256() + '"';
            response.setHeader("ETag", tag);
            response.setHeader("Cache-Control", "private, max-age=31536000, immutable");
            if (tag.equals(request.getHeader("If-None-Match"))) {
                response.setStatus(HttpServletResponse.SC_NOT_MODIFIED);
                return;
            }
            byte[] bytes = read(image);
            response.setContentType(image.contentType());
            response.setContentLength(bytes.length);
            response.setHeader("Content-Disposition", "inline");
            response.getOutputStream().write(bytes);
        } catch (Problem problem) {
            onRejection.accept(problem);
            response.setHeader("Cache-Control", "no-store");
            if (problem.status() == HttpServletResponse.SC_SERVICE_UNAVAILABLE) {
                response.setHeader("Retry-After", "1");
            }
            problem.answer(response);
        }
    }

    private ImageLocation find(String sha256) {
        if (folders.isEmpty()) {
            throw new Problem(
                    404,
                    "unknown-image",
                    "the dashboard has no folder of images: mount their store as a folder, and name it with --images");
        }
        return index.find(sha256)
                .orElseThrow(() -> new Problem(404, "unknown-image", "data.images names no image with this SHA-256"));
    }

    private byte[] read(ImageLocation image) throws IOException {
        Path file = locate(image.location());
        if (Files.size(file) > MAX_BYTES) {
            throw new Problem(
                    413,
                    "image-too-large",
                    "the image has %d bytes; up to %d are served".formatted(Files.size(file), MAX_BYTES));
        }
        byte[] bytes = Files.readAllBytes(file);
        if (!Sha256.hex(bytes).equals(image.sha256())) {
            throw new Problem(502, "image-changed", "the stored file has changed: its SHA-256 is different");
        }
        return bytes;
    }

    /** @throws Problem unless the location is a file below one of the folders */
    private Path locate(URI location) throws IOException {
        if (!"file".equals(location.getScheme())) {
            throw new Problem(
                    501,
                    "image-store-not-served",
                    "images at %s are not served by the dashboard: mount the store as a folder, and name it with --images"
                            .formatted(location.getScheme()));
        }
        try {
            Path file = Path.of(location);
            for (Path folder : folders) {
                if (Files.isRegularFile(file) && file.toRealPath().startsWith(folder.toRealPath())) {
                    return file.toRealPath();
                }
            }
        } catch (IllegalArgumentException e) { // includes InvalidPathException
            throw new Problem(404, "unknown-image", "the location of the image is not a path: " + e.getMessage());
        }
        throw new Problem(
                404, "unknown-image", "the image is not a file below the folders of --images, or has been deleted");
    }
}
