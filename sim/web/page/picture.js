/* Pictures to bytes. SPDX-License-Identifier: MIT */

const AS_IT_IS = { premultiplyAlpha: 'none', colorSpaceConversion: 'none' };

/* Of an image with alpha: a 2D canvas multiplies colours by it and rounds them, WebGL gives them as the file has them.
 * null: there is no WebGL, or the image is too large for it. */
function byWebGl(image) {
    const gl = new OffscreenCanvas(1, 1).getContext('webgl');
    if (!gl || Math.max(image.width, image.height) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) return null;
    const { TEXTURE_2D: FLAT, FRAMEBUFFER: FRAME, RGBA, UNSIGNED_BYTE: BYTE } = gl,
        rgba = new Uint8Array(4 * image.width * image.height),
        texture = gl.createTexture();
    gl.bindTexture(FLAT, texture);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    gl.texImage2D(FLAT, 0, RGBA, RGBA, BYTE, image);
    gl.bindFramebuffer(FRAME, gl.createFramebuffer());
    gl.framebufferTexture2D(FRAME, gl.COLOR_ATTACHMENT0, FLAT, texture, 0);
    const whole = gl.checkFramebufferStatus(FRAME) === gl.FRAMEBUFFER_COMPLETE;
    if (whole) gl.readPixels(0, 0, image.width, image.height, RGBA, BYTE, rgba);
    const good = whole && gl.getError() === 0;
    gl.getExtension('WEBGL_lose_context')?.loseContext();
    return good ? rgba : null;
}

/** A picture's bytes. rounded: colours of its texels with alpha are not quite those of the file. */
export async function decodePicture(bytes) {
    const image = await createImageBitmap(new Blob([bytes]), AS_IT_IS),
        { width, height } = image;
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const clear = data.some((v, i) => i % 4 === 3 && v < 255),
        exact = clear ? byWebGl(image) : data;
    return { width, height, rgba: exact || data, rounded: !exact };
}
