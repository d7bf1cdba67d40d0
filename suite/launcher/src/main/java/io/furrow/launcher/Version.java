package io.furrow.launcher;

/** Prints which release this is, as the manifest of its jar says. Needs no other class: {@code furrow --version} waits for it alone. */
final class Version {
    static final String TEXT = "furrow " + release();

    private Version() {}

    public static void main(String... args) {
        System.out.println(TEXT);
    }

    private static String release() {
        String release = Version.class.getPackage().getImplementationVersion();
        return release == null ? "of no release" : release;
    }
}
