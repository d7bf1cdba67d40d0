/** Small files that people edit while a process runs: secrets, tokens, certificates. */
package io.furrow.model.file;
