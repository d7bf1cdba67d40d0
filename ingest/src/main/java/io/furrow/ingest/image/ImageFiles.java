package io.furrow.ingest.image;

import java.io.File;
import java.io.FileNotFoundException;
import java.io.IOException;
import java.net.URI;
import java.util.Set;
import java.util.UUID;

import org.apache.flink.core.fs.FSDataInputStream;
import org.apache.flink.core.fs.FSDataOutputStream;
import org.apache.flink.core.fs.FileStatus;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.fs.FileSystem.WriteMode;
import org.apache.flink.core.fs.Path;

import io.furrow.mission.image.ImageName;
import io.furrow.model.text.Sha256;

/**
 * Stores images as files on a Flink file system. A file appears atomically: it is written under another name and renamed, or
 * put at once on object stores. An existing equal image is not written again; an existing different one is not overwritten,
 * the new image gets a name with its hash. On the local file system an image and its name are synced to the disk before the
 * call returns, so that a later checkpoint may rely on them.
 */
final class ImageFiles implements ImageStore {
    /** Stores in which a rename is a copy and a put is atomic. */
    private static final Set<String> OBJECT_STORES = Set.of("s3", "s3a", "s3n", "s3p", "gs", "oss", "wasb", "wasbs");

    private final String root;
    private final FileSystem files;
    private final boolean atomicPut;
    private final boolean local;

    ImageFiles(String root, FileSystem files) {
        this.root = root;
        this.files = files;
        String scheme = URI.create(root).getScheme();
        this.local = "file".equals(scheme); // its type is unknown: Flink wraps it in a task
        this.atomicPut = OBJECT_STORES.contains(scheme);
    }

    /** @throws IOException if there is no file system for this kind of URI */
    static ImageFiles in(String root) throws IOException {
        return new ImageFiles(root, path(root).getFileSystem());
    }

    /** Writes an image unless it exists. */
    @Override
    public StoredImage store(ImageName name, Image image) throws IOException {
        String first = root + "/" + name.path(image.format().extension());
        String url = switch (found(path(first), image)) {
            case NOTHING -> write(first, image);
            case THE_SAME -> named(first);
            case ANOTHER -> storeBeside(name, image);
        };
        return StoredImage.of(url, image);
    }

    /** The same under the name with its hash, which is unique. */
    StoredImage storeByHash(ImageName name, Image image) throws IOException {
        return StoredImage.of(storeBeside(name, image), image);
    }

    private String storeBeside(ImageName name, Image image) throws IOException {
        String second = root + "/" + name.path(image.format().extension(), image.sha256());
        Found found = found(path(second), image);
        if (found == Found.ANOTHER) {
            files.delete(path(second), false); // only a damaged file of the same image can have its hash
        }
        return found == Found.THE_SAME ? named(second) : write(second, image);
    }

    private enum Found {
        NOTHING,
        THE_SAME,
        ANOTHER
    }

    private Found found(Path path, Image image) throws IOException {
        try {
            FileStatus status = files.getFileStatus(path);
            boolean same = status.getLen() == image.bytes().length
                    && Sha256.hex(read(path, image.bytes().length)).equals(image.sha256());
            return same ? Found.THE_SAME : Found.ANOTHER;
        } catch (FileNotFoundException e) {
            return Found.NOTHING;
        }
    }

    private byte[] read(Path path, int length) throws IOException {
        try (FSDataInputStream in = files.open(path)) {
            return in.readNBytes(length);
        }
    }

    private String write(String url, Image image) throws IOException {
        Path target = path(url);
        if (atomicPut) {
            put(target, image.bytes(), WriteMode.OVERWRITE);
            return url;
        }
        Path unfinished = new Path(target.getParent(), ImageName.UNFINISHED + UUID.randomUUID());
        put(unfinished, image.bytes(), WriteMode.NO_OVERWRITE);
        if (!files.rename(unfinished, target)) {
            files.delete(unfinished, false);
            throw new IOException("cannot rename a file to " + url);
        }
        return named(url);
    }

    /** A file's name is durable when its folder is synced, that of a new folder when its parent is. */
    private String named(String url) throws IOException {
        if (local) {
            java.nio.file.Path top = folder(path(root)).getParent();
            for (var each = folder(path(url).getParent()); each != null && !each.equals(top); each = each.getParent()) {
                LocalFolder.sync(each);
            }
        }
        return url;
    }

    /** Flink takes the text of a path literally, without the percent-encoding of a URL. */
    private static Path path(String url) {
        return new Path(URI.create(url));
    }

    private static java.nio.file.Path folder(Path path) {
        return new File(path.getPath()).toPath().normalize();
    }

    private void put(Path path, byte[] bytes, WriteMode mode) throws IOException {
        boolean written = false;
        try {
            try (FSDataOutputStream out = files.create(path, mode)) {
                out.write(bytes);
                if (local) {
                    out.sync();
                }
            }
            written = true;
        } finally {
            if (!written) {
                files.delete(path, false); // closing may have created a partial file
            }
        }
    }
}
