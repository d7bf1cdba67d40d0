package io.furrow.connect.sink.api;

/** No request can succeed until a setting is changed. */
public final class WrongSettingException extends Exception {
    private static final long serialVersionUID = 1L;

    WrongSettingException(String words) {
        super(words);
    }
}
