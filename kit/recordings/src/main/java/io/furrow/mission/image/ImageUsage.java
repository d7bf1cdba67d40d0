package io.furrow.mission.image;

import java.io.FileNotFoundException;
import java.io.IOException;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

import org.apache.flink.core.fs.FileStatus;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.fs.Path;

/**
 * Counts the images of one domain and mission, of all tenants, in a folder.
 *
 * @param domain encoded as in the folder's name; empty for none
 * @param mission encoded as in the folder's name; empty for none
 * @param entities number of entities with images
 */
public record ImageUsage(String domain, String mission, long entities, long images, long bytes) {
    private static final Pattern IMAGE = Pattern.compile(".+_\\d{17}(-[0-9a-f]{64})?\\.(png|jpg)");
    private static final String NONE = ImageName.part("");

    /**
     * Counts the images below a folder.
     *
     * @param root the folder of the job's option {@code --images}
     * @throws IOException if it does not exist or cannot be read; the message names it
     */
    public static List<ImageUsage> of(Path root) throws IOException {
        FileSystem files = root.getFileSystem();
        try {
            files.getFileStatus(root);
        } catch (FileNotFoundException e) {
            throw new IOException(root + " is not there; name the folder of --images", e);
        }
        Map<String, ImageUsage> all = new LinkedHashMap<>();
        add(files, root, all);
        return List.copyOf(all.values());
    }

    /** Adds the images of the domains of a folder, including the folders of tenants and service paths. */
    private static void add(FileSystem files, Path folder, Map<String, ImageUsage> all) throws IOException {
        for (FileStatus domain : folders(files, folder)) {
            if (ImageName.isScope(domain.getPath().getName())) {
                add(files, domain.getPath(), all);
                continue;
            }
            for (FileStatus mission : folders(files, domain.getPath())) {
                ImageUsage usage = of(files, domain.getPath(), mission.getPath());
                if (usage.images() > 0) {
                    all.merge(usage.domain() + "/" + usage.mission(), usage, ImageUsage::plus);
                }
            }
        }
    }

    private ImageUsage plus(ImageUsage other) {
        return new ImageUsage(domain, mission, entities + other.entities, images + other.images, bytes + other.bytes);
    }

    private static ImageUsage of(FileSystem files, Path domain, Path mission) throws IOException {
        long entities = 0;
        long images = 0;
        long bytes = 0;
        for (FileStatus entity : folders(files, mission)) {
            long before = images;
            for (FileStatus file : list(files, entity.getPath())) {
                if (!file.isDir() && IMAGE.matcher(file.getPath().getName()).matches()) {
                    images++;
                    bytes += file.getLen();
                }
            }
            entities += images > before ? 1 : 0;
        }
        return new ImageUsage(name(domain), name(mission), entities, images, bytes);
    }

    private static String name(Path folder) {
        return folder.getName().equals(NONE) ? "" : folder.getName();
    }

    private static List<FileStatus> folders(FileSystem files, Path folder) throws IOException {
        return list(files, folder).stream().filter(FileStatus::isDir).toList();
    }

    private static List<FileStatus> list(FileSystem files, Path folder) throws IOException {
        FileStatus[] found = files.listStatus(folder);
        return found == null ? List.of() : List.of(found); // null if it was deleted meanwhile
    }
}
