/** Images on file systems that other machines keep. */
package io.furrow.stores;
